#include "sinew/scene/scene.h"

#include <gtest/gtest.h>
#include <utility>

/// Colliders and motions that are none are refused with a message.
namespace sinew::SINEW_TEST_FILE {
namespace {

std::string told(const std::string& members) {
    auto document = load(R"({"sinew": 1, )" + members + "}", "test.json");
    open_scene(document);
    return to_text(document.diagnostics);
}

TEST(ColliderErrors, SayWhatIsMissing) {
    const auto mesh = [](const std::string& of) {
        return R"("dimension": 3, "colliders": [{"shape": "mesh", )" + of + "}]";
    };
    const auto chain = [](const std::string& of) { return R"("colliders": [{"shape": "chain", )" + of + "}]"; };
    const auto moved = [](const std::string& driver) {
        return R"("colliders": [{"shape": "sphere", "motion": {"driver": )" + driver + "}}]";
    };
    for (
        const auto& [members, message] :
        {std::pair(mesh(R"("points": [], "triangles": [[0, 1, 2]])"), "a mesh needs points, found none"),
         std::pair(mesh(R"("points": [], "triangles": [])"), "a mesh needs points, found none"),
         std::pair(mesh(R"("points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [])"),
                   "a mesh needs triangles, found none"),
         std::pair(mesh(R"("points": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "triangles": [[0, 1, 3]])"),
                   "there is no point 3; the points are 0 to 2"),
         std::pair(chain(R"("points": [[0, 0], [0, 0]])"), "points 0 and 1 of the chain are in the same place"),
         std::pair(chain(R"("points": [[0, 0], [1, 0], [1, 1], [0, 0]], "closed": true)"),
                   "points 3 and 0 of the chain are in the same place"),
         std::pair(chain(R"("points": [])"), "a chain needs at least 2 points, found 0"),
         std::pair(moved(R"("path", "keys": [])"), "a path needs at least one key"),
         std::pair(
             std::string(
                 R"("figures": [{"prefab": "rope"}], "pins": [{"particle": "rope/p0", "driver": "path", "keys": []}])"),
             "a path needs at least one key")}) {
        const auto text = told(members);
        EXPECT_NE(text.find(message), std::string::npos) << members << "\n" << text;
        EXPECT_NE(text.find("test.json:1:"), std::string::npos);
    }
    EXPECT_EQ(told(chain(R"("points": [[0, 0], [1, 0], [0, 0]])")), "") << "there and back";
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#include "sinew/scene/document.h"
#include "sinew/scene/scene.h"

#include "tests/stepped.h"

#include <gtest/gtest.h>

/// Meshes in scene files: the model is read by whoever opens the scene.
namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr const char* triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string scene_with(const std::string& file, const std::string& more = "") {
    return R"({"sinew": 1, "dimension": 3, "figures": [{"prefab": "mesh", "name": "sail", "file": ")" + file + '"' +
           more + "}]}";
}

/// Opens it where every model holds that text; what is wrong is in `problems`.
std::optional<Opened> open_with(const std::string& scene, const std::string& model, std::string& problems,
                                int* reads = nullptr, std::span<const Override> overrides = {}) {
    auto document = load(scene, "scene.json", overrides);
    auto opened = open_scene(document, {}, [&](const std::string& name, const Limits& limits) {
        if (reads) ++*reads;
        return read_model(model, name, limits);
    });
    problems = to_text(document.diagnostics);
    return opened;
}

TEST(Models, GiveAMeshItsPoints) {
    std::string problems;
    const auto opened = open_with(scene_with("models/sail.obj", R"(, "size": 2, "pin_list": [0])"), triangle, problems);
    ASSERT_TRUE(opened) << problems;
    const auto& world = std::get<World<3, double>>(opened->world);
    EXPECT_EQ(world.particles.size(), 3U);
    EXPECT_EQ(position_of(world, *find_particle(world, "sail/vertex_1")), (Vec3<double>{{2, 0, 0}}));
}

TEST(Models, AreReadOnceHoweverManyMeshesThereAre) {
    std::string problems;
    int reads = 0;
    const auto text = R"({"sinew": 1, "dimension": 3, "figures": [{"prefab": "mesh", "name": "a", "file": "x.obj"},
        {"prefab": "mesh", "name": "b", "file": "x.obj"}, {"prefab": "mesh", "name": "square"}]})";
    ASSERT_TRUE(open_with(text, triangle, problems, &reads)) << problems;
    EXPECT_EQ(reads, 1);
}

TEST(Models, ThatCannotBeReadAreToldWithPlaceAndLine) {
    std::string problems;
    EXPECT_FALSE(open_with(scene_with("sail.obj"), "v 0 0 0\nf 1 2 3\n", problems));
    EXPECT_NE(problems.find("scene.json:1:"), std::string::npos) << problems;
    EXPECT_NE(problems.find("/figures/0/file"), std::string::npos) << problems;
    EXPECT_NE(problems.find("sail.obj:2: there are 1 points above this line"), std::string::npos) << problems;
    EXPECT_FALSE(open_with(scene_with("sail.obj", R"(, "pin_list": [3])"), triangle, problems));
    EXPECT_NE(problems.find("counted from 0 to 2"), std::string::npos) << problems;
    const Override fewer{"limits.particles=2"};
    EXPECT_FALSE(open_with(scene_with("sail.obj"), triangle, problems, nullptr, std::span(&fewer, 1)));
    EXPECT_NE(problems.find("more than 2 points"), std::string::npos) << problems;
}

TEST(Models, LieInTheFolderOfTheScene) {
    for (const auto* bad : {"/etc/passwd", "../sail.obj", "a/../../b.obj", "c:sail.obj", "a\\\\b.obj"}) {
        std::string problems;
        int reads = 0;
        EXPECT_FALSE(open_with(scene_with(bad), triangle, problems, &reads)) << bad;
        EXPECT_NE(problems.find("is not a file in the folder of the scene"), std::string::npos) << problems;
        EXPECT_EQ(reads, 0);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

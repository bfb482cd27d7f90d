#include "sinew/scene/scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <string>

/// Places where figures begin that are allowed, and seldom meant.
namespace sinew::SINEW_TEST_FILE {
namespace {

std::string warnings_of(const std::string& scene) {
    auto document = load(scene, "a.json");
    const auto opened = open_scene(document);
    return to_text(document.diagnostics) + warnings_text(document.diagnostics);
}

testing::AssertionResult says(const std::string& text, std::string_view part) {
    if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "not said: " << part << "\nin: " << text;
}

/// Two figures of a prefab, the second one beside the first.
std::string pair(int dimension, const std::string& prefab, double apart, const std::string& one = "",
                 const std::string& other = "", const std::string& more = "") {
    const auto second = dimension == 3 ? fmt::format("[{}, 0, 0]", apart) : fmt::format("[{}, 0]", apart);
    return warnings_of(fmt::format(R"({{"sinew": 1, "dimension": {}, "figures": [
        {{"prefab": "{}", "name": "x"{}}}, {{"prefab": "{}", "name": "y", "at": {}{}}}]{}}})",
                                   dimension, prefab, one, prefab, second, other, more));
}

constexpr const char* touching = R"(, "contact": {"figures": true})";

TEST(Overlap, OfFiguresThatCannotTouchIsWarnedOf) {
    for (const int dimension : {2, 3})
        for (const char* prefab : {"box", "ball"})
            for (const double apart : {0.0, 0.1, 0.15}) {
                const auto said = pair(dimension, prefab, apart);
                EXPECT_TRUE(says(said, "\"y\" begins in \"x\", and they cannot touch")) << prefab << dimension << apart;
                EXPECT_TRUE(says(said, "at /figures/1"));
                EXPECT_TRUE(says(said, "give \"x\" and \"y\" \"contact\": {\"figures\": true}"));
                EXPECT_TRUE(says(pair(dimension, prefab, apart, touching), "give \"y\" \"contact\"")) << "one of two";
                EXPECT_EQ(pair(dimension, prefab, apart, touching, touching), "") << "contact parts them";
            }
}

TEST(Overlap, ThatIsMeantIsNotWarnedOf) {
    const std::string apart = R"(, "contact": {"figures": true, "layers": [1], "touches": [0]})";
    EXPECT_EQ(pair(2, "box", 0.1, apart, apart), "") << "layers";
    EXPECT_EQ(pair(2, "box", 1.5), "") << "apart";
    EXPECT_EQ(pair(2, "box", 1), "") << "flush";
    EXPECT_EQ(pair(3, "box", 1), "") << "flush";
    EXPECT_EQ(pair(2, "box", 0.1, "", "", R"(, "pins": [{"particle": "x/top_left"}, {"particle": "x/top_right"},
        {"particle": "x/bottom_left"}, {"particle": "x/bottom_right"}])"),
              "")
        << "scenery";
    EXPECT_EQ(pair(2, "rope", 0.1), "") << "lines have no inside";
    EXPECT_EQ(pair(2, "box", 0.1, "", "", R"(, "constraints": [{"between": ["x/top_left", "y/top_left"], "high": 2}])"),
              "")
        << "joined";
}

TEST(Overlap, OfManyFiguresIsOneWarning) {
    const auto box = [](int i) { return fmt::format(R"({{"prefab": "box", "name": "b{}"}})", i); };
    const auto said = warnings_of(fmt::format(R"({{"sinew": 1, "figures": [{}, {}, {}]}})", box(0), box(1), box(2)));
    EXPECT_TRUE(
        says(said, "\"b1\" begins in \"b0\", and they cannot touch: nothing keeps them apart, nor 2 other pairs"));
}

// Half a step of floats at x is x / 2^24: above 1e-3 r from x = 1e-3 r 2^24 on, 168 for r = 0.01.
TEST(Floats, AreWarnedOfWhereTheyRoundAShareOfARadius) {
    const auto ball = [](const char* precision, double x, double radius) {
        return warnings_of(fmt::format(R"({{"sinew": 1, "solver": {{"precision": "{}"}},
            "figures": [{{"prefab": "ball", "radius": {}, "at": [{}, 1]}}]}})",
                                       precision, radius, x));
    };
    const auto said = ball("float", 1e5, 0.01);
    EXPECT_TRUE(says(said, "\"ball\" is 1e+05 from the origin, where floats are rounded by 0.00596")) << said;
    EXPECT_TRUE(says(said, "stay within 168 of the origin"));
    EXPECT_TRUE(says(said, "at /figures/0"));
    EXPECT_TRUE(says(ball("float", -169, 0.01), "from the origin"));
    EXPECT_EQ(ball("float", 167, 0.01), "");
    EXPECT_EQ(ball("float", 1600, 0.1), "");
    EXPECT_EQ(ball("double", 1e5, 0.01), "");
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

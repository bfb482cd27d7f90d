#include "sinew/session/focus.h"
#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include <gtest/gtest.h>

/// View of a picture where the scene has none of its own.
namespace sinew::SINEW_TEST_FILE {
namespace {

/// Corners around a square of one metre whose middle is (0, 1).
std::array<Point, 2> focus_with(const std::string& more) {
    auto document = load(R"({"sinew": 1, "figures": [{"name": "square", "particles": {
        "a": {"at": [-0.5, 0.5]}, "b": {"at": [0.5, 0.5]}, "c": {"at": [0.5, 1.5]}, "d": {"at": [-0.5, 1.5]}}}])" +
                             more + "}",
                         "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return focus_of(opened->scene, opened->world);
}

std::array<Point, 2> corners(double left, double low, double right, double high) {
    return {{{{left, low, 0}}, {{right, high, 0}}}};
}

TEST(Focus, FiguresHaveRoomOfHalfTheirSide) {
    EXPECT_EQ(focus_with(""), corners(-1, 0, 1, 2));
}

TEST(Focus, ARoomIsShownAsAWhole) {
    EXPECT_EQ(focus_with(R"(, "world": {"bounds": {"box": [[-3, 0], [3, 4]]}})"), corners(-3, 0, 3, 4));
}

/// Figures in a tower of a kilometre are no dots: walls are shown as far as ten sides of the figures away.
TEST(Focus, FarWallsAreLeftOut) {
    EXPECT_EQ(focus_with(R"(, "world": {"bounds": {"box": [[-3, 0], [3, 1000]]}})"), corners(-3, 0, 3, 11.5));
}

TEST(Focus, CollidersNearTheFiguresAreShown) {
    EXPECT_EQ(focus_with(R"(, "colliders": [{"shape": "box", "at": [0, -0.5], "size": [100, 1]}])"),
              corners(-2.5, -1, 2.5, 2));
    EXPECT_EQ(focus_with(R"(, "colliders": [{"shape": "box", "at": [0, -9], "size": [100, 1]}])"),
              corners(-1, 0, 1, 2));
}

/// Figures of calls are shown from the first step on as they were then.
TEST(Focus, AWorldThatIsBuiltLaterIsShownAsItIsAtTheFirstStep) {
    auto document = load(R"({"sinew": 1, "world": {"gravity": [0, -10]}})", "test.json");
    Session session(*open_scene(document));
    session.step();
    EXPECT_EQ(session.focus(), corners(0, 0, 0, 0));
    std::visit(
        []<int D, class Real>(World<D, Real>& world) {
            for (const double x : {-1, 1})
                add_particle(world, ParticleSpec<D, Real>{.position = Vec<D, Real>::axis(0) * Real(x), .mass = 1});
        },
        session.world());
    EXPECT_EQ(session.focus(), corners(-2, -1, 2, 1));
    session.run_until(2);
    EXPECT_EQ(session.focus(), corners(-2, -1, 2, 1));
    session.restart();
    EXPECT_EQ(session.focus(), corners(0, 0, 0, 0)) << "as empty as it was";
}

TEST(Focus, ASceneOfNothingIsShownAroundItsOrigin) {
    auto document = load(R"({"sinew": 1})", "test.json");
    auto opened = open_scene(document);
    ASSERT_TRUE(opened);
    EXPECT_EQ(focus_of(opened->scene, opened->world), corners(0, 0, 0, 0));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

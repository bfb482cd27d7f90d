#include "sinew/world/edit.h"

#include "player/joints.h"
#include "player/quantity.h"
#include "player/scene_edit.h"
#include "tests/canvas/scratch_folder.h"
#include "tests/play/game.h"

#include <cmath>
#include <fstream>

/// Walls, ground and joints drawn by hand, and curves of quantities.
namespace sinew::play::SINEW_TEST_FILE {
namespace {

using games::Listening;
using games::pixel_of;

constexpr const char* two_balls = R"({"sinew": 1, "view": {"center": [0, 1], "height": 4},
    "world": {"gravity": [0, -9.81]},
    "figures": [{"prefab": "ball", "name": "a", "at": [-0.5, 1.5], "radius": 0.1, "mass": 1},
                {"prefab": "box", "name": "b", "at": [0.5, 1.5], "width": 0.3, "height": 0.3, "mass": 1}]})";

struct Building : testing::Test {
    Building() {
        std::ofstream(folder / "two.json") << two_balls;
        play.open(folder / "two.json");
        play.resize(800, 600);
        play.pause(true);
        EXPECT_EQ(play.problem(), "");
    }
    void drag(Vec2<double> from, Vec2<double> to) {
        play.handle(Moved{from});
        play.handle(Pressed{});
        for (const double share : {0.25, 0.5, 0.75, 1.0}) play.handle(Moved{from + (to - from) * share});
        play.handle(Released{});
    }
    Point middle(const std::string& name) {
        return middle_of(play.session().scene(), play.session().world(), {name, false}).value_or(Point{});
    }
    void run(double seconds) {
        play.pause(false);
        for (int i = 0; i < int(seconds * 60); ++i) play.advance(1.0 / 60);
    }
    void expect_opens_again() {
        const auto again = games::read(text_of(play.session()), "again");
        EXPECT_TRUE(again.opened) << again.problem << text_of(play.session());
    }

    ScratchFolder folder;
    Play play{games::library, "ragdoll"};
};

TEST_F(Building, AWallHoldsWhatFallsOnIt) {
    play.tool = "wall";
    drag({{100, 500}}, {{700, 500}});
    ASSERT_EQ(play.session().scene().colliders.size(), 1u) << play.problem();
    expect_opens_again();
    run(3);
    const double wall = 1 - 200.0 / 150; // 500 pixels from the top
    EXPECT_NEAR(middle("a")[1], wall + 0.1 + 7.0 / 150, 0.01) << "on the wall's upper side";
}

TEST_F(Building, GroundIsSolidBelowWhicheverWayItIsDrawn) {
    play.tool = "terrain";
    drag({{700, 520}}, {{100, 480}});
    ASSERT_EQ(play.session().scene().colliders.size(), 1u) << play.problem();
    expect_opens_again();
    run(1);
    EXPECT_GT(middle("a")[1], -0.5);
}

TEST_F(Building, EveryJointCanBeSavedAndOpened) {
    for (const auto& joint : joints)
        for (const bool on_background : {false, true}) {
            play.tool = "join";
            play.joint = joint.name;
            const auto from = pixel_of(play, "a/ball");
            drag(from, on_background ? from + Vec2<double>{{0, -90}} : pixel_of(play, "b/top_left"));
            EXPECT_EQ(play.problem(), "") << joint.name << on_background;
            EXPECT_EQ(play.session().scene().figures.size(), 3u) << joint.name << on_background << play.message;
            expect_opens_again();
            run(0.5);
            std::visit(
                [](const auto& world) {
                    for (const auto& figure : world.figures) EXPECT_FALSE(figure.quarantined);
                },
                play.session().world());
            play.restart();
            play.pause(true);
            play.undo();
            ASSERT_EQ(play.session().scene().figures.size(), 2u);
        }
}

TEST_F(Building, AHingeOnTheBackgroundKeepsItsDistance) {
    play.tool = "join";
    const auto from = pixel_of(play, "a/ball");
    drag(from, from + Vec2<double>{{90, -90}});
    const auto anchor = pixel_of(play, "hinge/anchor");
    const double length = distance(anchor, from);
    EXPECT_NEAR(length, 90 * std::sqrt(2), 1);
    run(1);
    EXPECT_NEAR(distance(pixel_of(play, "a/ball"), pixel_of(play, "hinge/anchor")), length, 1);
    EXPECT_EQ(pixel_of(play, "hinge/anchor"), anchor);
}

TEST_F(Building, AWeldKeepsBothAsOneBody) {
    play.tool = "join";
    play.joint = "weld";
    drag(pixel_of(play, "b/top_left"), pixel_of(play, "a/ball"));
    const auto before = middle("a")[0] - middle("b")[0];
    run(0.6);
    const auto a = middle("a"), b = middle("b");
    EXPECT_NEAR(std::hypot(a[0] - b[0], a[1] - b[1]), std::fabs(before), 0.01);
}

// Joints are drawn between particles of other figures.
TEST_F(Building, AJointIsDrawnAfterTheNextEditToo) {
    play.tool = "join";
    play.joint = "spring";
    drag(pixel_of(play, "b/top_left"), pixel_of(play, "a/ball"));
    play.tool = "wall";
    drag({{100, 500}}, {{700, 500}});
    ASSERT_EQ(play.session().scene().colliders.size(), 1u) << play.problem();
    const auto found = std::visit(
        [](const auto& world) {
            const auto& joint = world.figures.back();
            EXPECT_EQ(joint.name, "spring");
            std::size_t drawn = 0;
            for (const auto& piece : joint.pieces)
                for (const auto id : piece.particles) drawn += row_of(world, id) ? 1 : 0;
            return drawn;
        },
        play.session().world());
    EXPECT_EQ(found, 2u) << "both ends of its line";
}

TEST_F(Building, AWinchWindsItsRopeUp) {
    play.tool = "join";
    play.joint = "winch";
    const auto from = pixel_of(play, "a/ball");
    drag(from, from + Vec2<double>{{0, -150}});
    run(3);
    EXPECT_LT(distance(pixel_of(play, "a/ball"), pixel_of(play, "winch/anchor")), 25);
}

TEST_F(Building, AMotorTurnsWhatItIsOn) {
    play.tool = "join";
    play.joint = "motor";
    const auto corner = pixel_of(play, "b/top_left");
    drag(corner, corner + Vec2<double>{{3, 3}});
    ASSERT_EQ(play.session().scene().figures.size(), 3u) << play.problem() << play.message;
    const auto angle = [&] {
        const auto arm = pixel_of(play, "b/top_right") - pixel_of(play, "b/top_left");
        return std::atan2(-arm[1], arm[0]);
    };
    const double before = angle();
    run(0.5);
    EXPECT_NEAR(std::remainder(angle() - before, 2 * pi<double>), pi<double> / 2, 0.4) << "half a turn a second";
}

TEST_F(Building, AJointGoesWithTheFigureThatItJoins) {
    play.tool = "join";
    play.joint = "spring";
    drag(pixel_of(play, "a/ball"), pixel_of(play, "b/top_left"));
    ASSERT_EQ(play.session().scene().figures.size(), 3u);
    play.choose_all();
    play.handle(Key{"ctrl+d"});
    EXPECT_EQ(play.session().scene().figures.size(), 6u) << play.problem();
    expect_opens_again();
    play.remove({{"a", false}});
    EXPECT_EQ(play.session().scene().figures.size(), 4u) << "the spring has nothing to pull at";
    expect_opens_again();
}

TEST_F(Building, AnyQuantityHasAValueAndItIsRight) {
    play.handle(Moved{pixel_of(play, "a/ball")});
    play.handle(Pressed{});
    play.handle(Released{});
    const auto all = quantities_of(play);
    EXPECT_GT(all.size(), 12u);
    const auto report = play.session().report();
    for (const auto& quantity : all) {
        const auto value = value_of(quantity.name, play, report);
        ASSERT_TRUE(value) << quantity.name;
        EXPECT_TRUE(std::isfinite(*value)) << quantity.name;
    }
    EXPECT_NEAR(*value_of("a/ball: y", play, report), 1.5, 1e-9);
    run(0.5);
    EXPECT_NEAR(*value_of("a/ball: speed along y", play, play.session().report()), -9.81 * 0.5, 0.1);
    EXPECT_EQ(unit_of("a/ball: speed along y", play), "m/s");
    EXPECT_FALSE(value_of("c: y", play, report));
    EXPECT_FALSE(value_of("nonsense", play, report));
}

} // namespace
} // namespace sinew::play::SINEW_TEST_FILE

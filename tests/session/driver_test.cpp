#include "sinew/session/driver.h"
#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include "tests/session/positions.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

/// Pins that move by themselves.
namespace sinew::SINEW_TEST_FILE {
namespace {

constexpr Point rest{{450, 100, 0}};

void expect_near(const Point& a, const Point& b, double tolerance = 1e-9) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

// Coding Math's crank: 100 px at 0.05 radians a frame. A quarter turn is up, also where y points down.
TEST(Driver, OrbitGoesRoundCounterClockwiseAsSeen) {
    const OrbitDriver crank{.radius = 100, .rate = 0.05};
    expect_near(driven_to(crank, rest, 0, -1), {{550, 100, 0}});
    expect_near(driven_to(crank, rest, pi<double> / 2 / 0.05, -1), {{450, 0, 0}});
    expect_near(driven_to(crank, rest, pi<double> / 2 / 0.05, 1), {{450, 200, 0}});
    expect_near(driven_to(crank, rest, 2 * pi<double> / 0.05, -1), {{550, 100, 0}});
}

// The Bezier humanoid's root: x += 42 sin (120 frames), y += 24 sin (60 frames).
TEST(Driver, BobSwingsEachAxisInItsOwnTime) {
    const BobDriver root{.by = {{42, 24, 0}}, .period = {{120, 60, 1}}};
    expect_near(driven_to(root, rest, 0, -1), rest);
    expect_near(driven_to(root, rest, 30, -1), {{492, 100, 0}});
    expect_near(driven_to(root, rest, 15, -1), {{450 + 42 * std::sqrt(0.5), 124, 0}});
    expect_near(driven_to(root, rest, 120, -1), rest);
}

const std::vector<Keyframe> keys = {{10, {{460, 100, 0}}}, {20, {{460, 120, 0}}}, {40, {{450, 100, 0}}}};

TEST(Driver, PathIsAtItsKeysOnTimeAndStraightBetween) {
    const PathDriver path{.keys = keys};
    expect_near(driven_to(path, rest, 0, 1), rest);
    expect_near(driven_to(path, rest, 5, 1), {{455, 100, 0}});
    for (const auto& key : keys) expect_near(driven_to(path, rest, key.at, 1), key.to);
    expect_near(driven_to(path, rest, 30, 1), {{455, 110, 0}});
    expect_near(driven_to(path, rest, 1000, 1), keys.back().to);
}

TEST(Driver, PathRepeats) {
    const PathDriver path{.keys = keys, .repeat = true};
    for (const double t : {0.0, 5.0, 17.0, 33.0})
        expect_near(driven_to(path, rest, t + 80, 1), driven_to(path, rest, t, 1));
}

TEST(Driver, ASmoothPathPassesItsKeysAndTurnsThereWithoutACorner) {
    const PathDriver path{.keys = {{10, {{10, 0, 0}}}, {20, {{20, 10, 0}}}, {30, {{30, 0, 0}}}}, .smooth = true};
    const Point start{};
    for (const auto& key : path.keys) expect_near(driven_to(path, start, key.at, 1), key.to);
    constexpr double h = 1e-4;
    for (int i = 0; i < 2; ++i) {
        const double before = driven_to(path, start, 20, 1)[i] - driven_to(path, start, 20 - h, 1)[i];
        const double after = driven_to(path, start, 20 + h, 1)[i] - driven_to(path, start, 20, 1)[i];
        EXPECT_NEAR(before / h, after / h, 1e-3);
    }
}

TEST(Driver, WithoutKeysAPinStaysWhereItIs) {
    expect_near(driven_to(PointerDriver{}, rest, 17, 1), rest);
}

Session driven_session(const std::string& driver, const std::string& mode = "physical", const std::string& more = "") {
    auto document = load(fmt::format(R"({{"sinew": 1, "units": {{"length": "px", "time": "frame", "up": "-y"}},
        "solver": {{"mode": "{}"}},
        "figures": [{{"name": "f", "particles": {{"a": {{"at": [450, 100], "pinned": true}}, "b": {{"at": [450, 100]}}}}}}],
        "pins": [{{"particle": "f/b", {}}}]{}}})",
                                     mode, driver, more),
                         "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}

TEST(Driver, CarriesItsParticleInBothModesAndNoOther) {
    for (const std::string mode : {"physical", "classic"}) {
        auto session = driven_session(R"("driver": "orbit", "radius": 100, "rate": 3)", mode); // degrees a frame
        for (int frame = 0; frame < 30; ++frame) session.step();
        EXPECT_NEAR(position(session, "f/b")[0], 450, 1e-9) << mode;
        EXPECT_NEAR(position(session, "f/b")[1], 0, 1e-9) << mode;
        EXPECT_EQ(position(session, "f/a"), (Vec2<double>{{450, 100}})) << mode;
        session.restart();
        for (int frame = 0; frame < 60; ++frame) session.step();
        EXPECT_NEAR(position(session, "f/b")[0], 350, 1e-9) << mode;
    }
}

TEST(Driver, FollowsThePointerOrThePathThatStandsInForIt) {
    auto session = driven_session(R"("driver": "pointer", "keys": [{"at": 10, "to": [500, 100]}])");
    for (int frame = 0; frame < 10; ++frame) session.step();
    EXPECT_NEAR(position(session, "f/b")[0], 500, 1e-9);
    session.point_at(Point{{320, 240, 0}});
    session.step();
    EXPECT_NEAR(position(session, "f/b")[0], 320, 1e-9);
    EXPECT_NEAR(position(session, "f/b")[1], 240, 1e-9);
    session.point_at({});
    session.step();
    EXPECT_NEAR(position(session, "f/b")[0], 500, 1e-9);
}

// x += x - x_prev + 0.05 d - 0.1 v: a damped oscillation of about 28 frames that overshoots, and ends at the pointer.
TEST(Driver, SteersTowardsThePointerAndOvershoots) {
    auto session = driven_session(
        R"("steer": [0.05, 0.05], "steer_damping": 0.1, "driver": "pointer", "keys": [{"at": 0, "to": [550, 100]}])",
        "classic");
    double x = 450, before = 450, max = 0;
    for (int frame = 1; frame <= 200; ++frame) {
        session.step();
        const double next = x + (x - before) * 0.9 + 0.05 * (550 - x);
        before = x, x = next;
        EXPECT_NEAR(position(session, "f/b")[0], x, 1e-9);
        max = std::max(max, x);
    }
    EXPECT_GT(max, 570);
    EXPECT_NEAR(x, 550, 0.1);
}

// A steered particle is not held: a kick is felt.
TEST(Driver, AKickReachesWhatSteers) {
    const auto far = [](const std::string& kick) {
        auto session = driven_session(
            R"("steer": [0.05, 0.05], "steer_damping": 0.9, "driver": "pointer", "keys": [{"at": 0, "to": [450, 100]}])",
            "classic", kick);
        double max = 0;
        for (int frame = 0; frame < 200; ++frame) {
            session.step();
            max = std::max(max, std::abs(position(session, "f/b")[0] - 450));
        }
        EXPECT_NEAR(position(session, "f/b")[0], 450, 0.1);
        return max;
    };
    EXPECT_EQ(far(""), 0);
    EXPECT_GT(far(R"(, "events": [{"at": 3, "kick": "f/b", "by": [16, 16], "seed": 1}])"), 1);
}

// Physical mode: a spring that has come to rest at the pointer, 0.5 / 0.05 = 10 px lower where gravity is 0.5.
TEST(Driver, SteersAsASpringInPhysicalMode) {
    auto session = driven_session(
        R"("steer": [0.05, 0.05], "steer_damping": 0.2, "driver": "pointer", "keys": [{"at": 0, "to": [550, 100]}])",
        "physical");
    for (int frame = 0; frame < 600; ++frame) session.step();
    EXPECT_NEAR(position(session, "f/b")[0], 550, 0.1);
}

TEST(Driver, KeysOutOfOrderAreAnError) {
    auto document = load(R"({"sinew": 1, "figures": [{"name": "f", "particles": {"a": {"at": [0, 0]}}}],
        "pins": [{"particle": "f/a", "driver": "path", "keys": [{"at": 2, "to": [0, 1]}, {"at": 1, "to": [0, 2]}]}]})",
                         "test.json");
    EXPECT_FALSE(open_scene(document));
    const auto text = to_text(document.diagnostics);
    EXPECT_NE(text.find("/pins/0/keys/1/at"), std::string::npos) << text;
    EXPECT_NE(text.find("not after"), std::string::npos) << text;
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

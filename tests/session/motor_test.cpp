#include "sinew/session/session.h"
#include "sinew/world/edit.h"
#include "sinew/world/measure.h"

#include "tests/session/positions.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

/// Motors, winches, pins and new values of a running scene.
namespace sinew::SINEW_TEST_FILE {
namespace {

Session play(const std::string& text) {
    auto document = load(text, "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}

/// An arm of 1 m about the origin; `motor` and `more` are constraints of its angle.
std::string arm(const std::string& motor, const std::string& more = "", const std::string& precision = "double") {
    return R"({"sinew": 1, "solver": {"precision": ")" + precision + R"("}, "figures": [{"name": "f", "particles": {
        "ref": {"at": [-1, 0], "pinned": true}, "hub": {"at": [0, 0], "pinned": true}, "tip": {"at": [1, 0]}},
        "constraints": [{"between": ["hub", "tip"]},
        {"kind": "angle", "between": ["ref", "hub", "tip"], )" +
           motor + "}" + more + "]}]}";
}

template <class Report> auto of_tip(const Session& session, Report&& report) {
    return std::visit(
        [&](const auto& world) {
            if constexpr (std::decay_t<decltype(world)>::dimension == 2) {
                const auto id = *find_particle(world, "f/tip");
                return report(cast<double>(*position_of(world, id)), cast<double>(*velocity_of(world, id)));
            } else {
                return report(Vec2<double>{}, Vec2<double>{});
            }
        },
        session.world());
}
double degrees_of(const Session& session) {
    return of_tip(session, [](const auto& at, const auto&) { return std::atan2(at[1], at[0]) * 180 / pi<double>; });
}
double speed_of(const Session& session) {
    return of_tip(session, [](const auto&, const auto& velocity) { return norm(velocity) * 180 / pi<double>; });
}

constexpr auto range = R"(, {"kind": "angle", "between": ["ref", "hub", "tip"], "low": -45, "high": 45})";

// The stop holds the arm while the motor presses with its torque, solved at once or swept.
TEST(Motor, ThatStallsAtAStopForgetsItsSpeed) {
    for (const std::string precision : {"double", "float"})
        for (const std::string direct : {"auto", "off"}) {
            auto session = play(arm(R"("max_force": 20, "drive": {"speed": 90})", range, precision));
            if (direct == "off")
                std::visit([](auto& world) { world.figures[0].direct = Direct::off; }, session.world());
            session.run_until(2);
            for (int i = 0; i < 120; ++i) {
                session.step();
                ASSERT_NEAR(degrees_of(session), 45, 0.5) << precision << direct << i;
            }
        }
}

// A hand that holds the arm for a second: after the release the motor goes on at its own speed, without a whip. While
// it gathers speed w with its torque it lags, and forgets, w^2 I / (2 torque).
TEST(Motor, ThatIsHeldGoesOnAtItsSpeedAfterwards) {
    auto text = arm(R"("max_force": 20, "drive": {"speed": 90})");
    text.back() = ',';
    auto session = play(text + R"("events": [{"at": 1, "grab": "f/tip"}, {"at": 2, "release": "f/tip"}]})");
    session.run_until(1.9);
    const double lag = square(pi<double> / 2) / (2 * 20) * 180 / pi<double>;
    EXPECT_NEAR(degrees_of(session), 90 - lag, 0.3);
    double fastest = 0;
    for (; session.seconds() < 3;) session.step(), fastest = std::max(fastest, speed_of(session));
    EXPECT_LT(fastest, 95);
    EXPECT_NEAR(degrees_of(session), 180 - 2 * lag, 2);
}

// The motor is all that moves the wheel of springs, against the bar that a rigid link and a damped spring hold: the bar
// is solved at once, and joined to what is swept.
TEST(Motor, TurnsAWheelBesideADampedSpring) {
    for (const std::string direct : {"auto", "off"}) {
        auto session = play(R"({"sinew": 1, "solver": {"direct": ")" + direct + R"("}, "figures": [
            {"prefab": "tire", "name": "rear", "at": [-0.9, -0.1], "radius": 0.36, "segments": 12, "mass": 6},
            {"prefab": "tire", "name": "front", "at": [0.9, -0.1], "radius": 0.36, "segments": 12, "mass": 6},
            {"name": "car", "particles": {"bow": {"at": [0.85, 0], "mass": 9}, "tail": {"at": [-0.98, 0.4], "mass": 9}},
             "constraints": [{"between": ["bow", "tail"]}]}], "constraints": [
            {"between": ["rear/center", "car/bow"]},
            {"between": ["front/center", "car/bow"], "compliance": 1e-4, "damping_time": 0.06},
            {"kind": "angle", "between": ["car/bow", "rear/center", "rear/corner_0"], "max_force": 200,
             "drive": {"speed": 300}}]})");
        const auto angle = [&] {
            const auto& world = std::get<World<2, double>>(session.world());
            const auto at = [&](const char* name) { return *position_of(world, *find_particle(world, name)); };
            const auto arm = at("rear/center") - at("car/bow"), spoke = at("rear/corner_0") - at("rear/center");
            return std::atan2(cross(arm, spoke), dot(arm, spoke)) * 180 / pi<double>;
        };
        const double begun = angle();
        session.run_until(3); // 900 degrees
        EXPECT_NEAR(std::remainder(angle() - begun - 180, 360), 0, 3) << direct;
    }
}

TEST(Motor, WithoutKeysTurnsForEver) {
    for (const std::string precision : {"double", "float"}) {
        auto session = play(arm(R"("max_force": 20, "drive": {"speed": -7200})", "", precision));
        session.run_until(10); // 200 turns
        EXPECT_NEAR(speed_of(session), 7200, 72) << precision;
    }
}

// Keys without a speed are met in time, as those of a pin's path; a speed bounds the way to them.
TEST(Winch, IsAtEachKeyInTime) {
    const std::string begin = R"({"sinew": 1, "figures": [{"name": "f", "particles": {"drum": {"at": [0, 0],
        "pinned": true}, "tip": {"at": [2, 0], "mass": 10}}, "constraints": [{"between": ["drum", "tip"], "rest": 2,
        "drive": )";
    auto session = play(begin + R"({"keys": [{"at": 1, "to": 2}, {"at": 3, "to": 1}]}}]}]})");
    const auto length = [&] { return of_tip(session, [](const auto& at, const auto&) { return norm(at); }); };
    const double lengths[][2] = {{0.5, 2}, {1, 2}, {2, 1.5}, {3, 1}, {4, 1}};
    for (const auto& [time, expected] : lengths) {
        session.run_until(time);
        EXPECT_NEAR(length(), expected, 1e-6) << time;
    }
    session = play(begin + R"({"speed": 0.25, "keys": [{"at": 1, "to": 2}, {"at": 3, "to": 1}]}}]}]})");
    session.run_until(3);
    EXPECT_NEAR(length(), 1.5, 1e-6);
    session.run_until(5.1);
    EXPECT_NEAR(length(), 1, 1e-6);
}

// The start of a rope is pinned by its prefab: driver, path and grab take it over, in 2D and 3D.
TEST(Pin, OfADriverTakesOverThatOfARope) {
    for (const int dimension : {2, 3}) {
        const auto point = [&](const std::string& x, const std::string& y) {
            return "[" + x + ", " + y + (dimension == 3 ? ", 1]" : "]");
        };
        const std::string begin = R"({"sinew": 1, "dimension": )" + std::to_string(dimension) +
                                  R"(, "world": {"gravity": )" + point("0", "-9.81") +
                                  R"(}, "figures": [{"prefab": "rope", "name": "r"}], )";
        const std::string pin = R"("pins": [{"particle": "r/start", )",
                          grab = R"("events": [{"at": 0, "grab": "r/start", )";
        for (const auto& what :
             {pin + R"("driver": "bob", "by": )" + point("0.2", "0") + R"(, "period": )" + point("0.6", "1") + "}]}",
              pin + R"("driver": "path", "keys": [{"at": 1, "to": )" + point("1", "1") + "}]}]}",
              pin + R"("compliance": 1e-4}]})", grab + R"("duration": 1, "to": )" + point("1", "0") + "}]}",
              grab + R"("compliance": 1e-4, "to": )" + point("0.1", "0") + "}]}"}) {
            auto session = play(begin + what);
            session.run_until(2);
            EXPECT_LT(session.report().stretch_max, 0.01) << begin << what;
        }
    }
}

TEST(Adjust, ChangesLimitsComplianceAndStrengthOfNamedConstraints) {
    auto session = play(R"({"sinew": 1, "world": {"gravity": [0, -10], "damping": 5}, "figures": [
        {"prefab": "rope", "name": "r", "length": 1, "segments": 4, "weight": 10, "mass": 0.001}], "events": [
        {"at": 0, "adjust": ["r/link_*"], "compliance": 0.001},
        {"at": 2, "adjust": ["r/link_0"], "high": 0.5, "compliance": 0},
        {"at": 4, "adjust": ["r/link_1"], "break_force": 50},
        {"at": 4, "resize": "r/end", "radius": 0.25}]})");
    const auto depth = [&] {
        const auto& world = std::get<World<2, double>>(session.world());
        return -(*position_of(world, *find_particle(world, "r/end")))[1];
    };
    session.run_until(1.9);
    EXPECT_NEAR(depth(), 1 + 4 * 100 * 0.001, 0.01) << "four springs of 1000 N/m under 100 N";
    session.run_until(3.9);
    EXPECT_NEAR(depth(), 0.5 + 0.75 + 3 * 100 * 0.001, 0.01);
    session.run_until(4.1);
    const auto& world = std::get<World<2, double>>(session.world());
    EXPECT_FALSE(find_constraint(world, "r/link_1")) << "100 N are more than 50";
    EXPECT_EQ(world.particles.radius[*row_of(world, *find_particle(world, "r/end"))], 0.25);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#include "sinew/scene/reader.h"
#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include "tests/session/positions.h"

#include <cmath>
#include <gtest/gtest.h>

/// What events do: those that repeat, that kick, that join, that grab many. A rate of 60: a step is a frame.
namespace sinew::SINEW_TEST_FILE {
namespace {

std::string told(const std::string& text) {
    auto document = load(text, "test.json");
    EXPECT_FALSE(open_scene(document));
    return to_text(document.diagnostics);
}

Session play(const std::string& rest) {
    auto document = load(R"({"sinew": 1, "units": {"length": "px", "time": "frame"}, )" + rest + "}", "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}

Vec2<double> speed(const Session& session, std::string_view name) {
    return *velocity_of(world_of(session), *find_particle(world_of(session), name));
}

constexpr auto two = R"("figures": [{"name": "f", "particles": {"a": {"at": [0, 0]}, "b": {"at": [10, 0]}}}], )";

TEST(FormerWords, AreErrorsThatNameTheNewOnes) {
    const auto text = told(R"({"sinew": 1, "pointer": {"pulls_within": 1, "cuts_within": 2},
        "colliders": [{"shape": "box", "angle": 30}],
        "figures": [{"name": "a", "particles": {"b": {"at": [0, 0]}}}],
        "events": [{"at": 1, "grab": "a/b", "to": [0, 0], "over": 2}, {"at": 1, "remove": [], "snip": []}]})");
    for (const std::string word : {"grab_radius", "cut_radius", "turn", "duration", "remove"})
        EXPECT_NE(text.find("renamed to \"" + word + "\""), std::string::npos) << word << " in " << text;
}

TEST(Event, HappensAgainAsOftenAsItSays) {
    auto session = play(std::string(two) + R"("events": [
        {"at": 3, "every": 10, "times": 4, "impulse": "f/a", "by": [1, 0]},
        {"at": 5, "every": 2.5, "impulse": "f/b", "by": [0, 1]}])");
    for (int frame = 0; frame < 100; ++frame) session.step();
    EXPECT_NEAR(speed(session, "f/a")[0], 4, 1e-9);
    EXPECT_NEAR(speed(session, "f/b")[1], 38, 1e-9) << "at 5, 7.5, ..., 97.5 and not at 100";
    session.restart();
    for (int frame = 0; frame < 20; ++frame) session.step();
    EXPECT_NEAR(speed(session, "f/a")[0], 2, 1e-9);
}

TEST(Event, ThatRepeatsIsChecked) {
    const std::string begin =
        R"({"sinew": 1, "figures": [{"prefab": "rope"}], "events": [{"at": 0, "impulse": "rope/end", "by": [1, 0], )";
    EXPECT_NE(told(begin + R"("times": 3}]})").find("needs an \"every\""), std::string::npos);
    EXPECT_NE(told(begin + R"("every": 0.01}]})").find("shorter than a step"), std::string::npos);
}

TEST(Kick, IsRandomWithinItsBoundsAndTheSameForTheSameSeed) {
    const auto kicked = [](const std::string& seed) {
        auto session = play(std::string(two) + R"("solver": {"mode": "classic"},
            "events": [{"at": 0, "every": 64, "kick": "f/*", "by": [16, 4], "seed": )" +
                            seed + "}]");
        std::vector<Vec2<double>> changes;
        Vec2<double> before[2] = {};
        for (int frame = 0; frame < 64 * 50; ++frame) {
            session.step();
            for (const int i : {0, 1}) {
                const auto now = speed(session, i == 0 ? "f/a" : "f/b");
                if (frame % 64 == 0)
                    changes.push_back(now - before[i]);
                else
                    EXPECT_NEAR(distance(now, before[i]), 0, 1e-9) << "only then";
                before[i] = now;
            }
        }
        return changes;
    };
    const auto first = kicked("1"), again = kicked("1"), other = kicked("2");
    EXPECT_EQ(first, again);
    EXPECT_NE(first, other);
    double max_x = 0, max_y = 0, sum = 0;
    for (const auto& change : first) {
        max_x = std::max(max_x, std::abs(change[0]));
        max_y = std::max(max_y, std::abs(change[1]));
        sum += change[0];
    }
    EXPECT_TRUE(max_x > 14 && max_x <= 16 + 1e-9) << max_x;
    EXPECT_TRUE(max_y > 3.5 && max_y <= 4 + 1e-9) << max_y;
    EXPECT_LT(std::abs(sum) / double(first.size()), 16 / std::sqrt(3.0) / 10 * 3)
        << "three deviations of the mean of 100";
    EXPECT_NE(first[0], first[1]) << "each particle its own";
}

TEST(Join, TiesWhatIsNearUntilItIsSnipped) {
    const std::string events = R"("events": [
        {"at": 10, "join": ["f/a", "f/b"], "name": "tie", "within": 5, "high": 10},
        {"at": 20, "every": 1, "join": ["f/a", "f/b"], "name": "tie", "within": 50, "high": 10},
        {"at": 20, "impulse": "f/b", "by": [2, 0]}, {"at": 60, "every": 1, "remove": ["f/tie"]}])";
    auto session = play(std::string(two) + events);
    for (int frame = 0; frame < 15; ++frame) session.step();
    EXPECT_FALSE(find_constraint(world_of(session), "f/tie")) << "they are 10 apart";
    for (int frame = 15; frame < 50; ++frame) session.step();
    ASSERT_TRUE(find_constraint(world_of(session), "f/tie"));
    EXPECT_NEAR(distance(position(session, "f/a"), position(session, "f/b")), 10, 1e-6);
    EXPECT_NEAR(speed(session, "f/a")[0], 1, 1e-6) << "half of the momentum went over";
    EXPECT_EQ(world_of(session).figures[0].pieces.back().part, "tie");
    EXPECT_EQ(std::get<0>(world_of(session).constraints).size(), 1U) << "only once while it lasts";
    for (int frame = 50; frame < 70; ++frame) session.step();
    EXPECT_FALSE(find_constraint(world_of(session), "f/tie"));
    for (const auto& piece : world_of(session).figures[0].pieces) EXPECT_NE(piece.part, "tie") << "no longer drawn";
}

TEST(Join, IsCheckedAsAConstraintIs) {
    const std::string begin = R"({"sinew": 1, "figures": [{"prefab": "rope"}], "events": [{"at": 0, )";
    EXPECT_NE(told(begin + R"("join": ["rope/start", "rope/knot"]}]})").find("/events/0/join/1"), std::string::npos);
    EXPECT_NE(told(begin + R"("join": ["rope/start"]}]})").find("distance needs 2 particles, found 1"),
              std::string::npos);
    EXPECT_NE(told(begin + R"("remove": ["rope/tie"]}]})").find("/events/0/remove/0"), std::string::npos);
}

TEST(Grab, CarriesWhatIsNearAlongAndLetsGoOfAll) {
    auto session =
        play(R"("figures": [{"prefab": "cloth", "name": "c", "columns": 11, "rows": 11, "spacing": 6}], "events": [
        {"at": 1, "grab": "c/particle_5_5", "to": [40, -30], "duration": 20, "within": 12.5}, {"at": 30, "release": "c/particle_5_5"}])");
    const auto middle = position(session, "c/particle_5_5"), beside = position(session, "c/particle_7_5");
    const auto pins = world_of(session).pins.size();
    for (int frame = 0; frame < 25; ++frame) session.step();
    EXPECT_EQ(world_of(session).pins.size(), pins + 13) << "a disc of two threads about the middle";
    EXPECT_NEAR(distance(position(session, "c/particle_5_5"), Vec2<double>{40, -30}), 0, 1e-9);
    EXPECT_NEAR(distance(position(session, "c/particle_7_5"), Vec2<double>{40, -30} + beside - middle), 0, 1e-9);
    for (int frame = 25; frame < 40; ++frame) session.step();
    EXPECT_EQ(world_of(session).pins.size(), pins);
}

TEST(Pointer, PullsWhatIsNearAlongAndLetsGoOfAll) {
    const std::string cloth =
        R"("figures": [{"prefab": "cloth", "name": "c", "columns": 11, "rows": 11, "spacing": 6, "tethers": false, "pins": "none"}], )";
    const auto pinned = [&](const std::string& pointer, double reach) {
        auto session = play(cloth + pointer + R"("seconds": 1)");
        const auto before = world_of(session).pins.size();
        const auto middle = position(session, "c/particle_5_5"), beside = position(session, "c/particle_7_5");
        const auto id = *find_particle(world_of(session), "c/particle_5_5");
        EXPECT_TRUE(session.grab(std::span(&id, 1), Point{{middle[0], middle[1], 0}}));
        const auto taken = world_of(session).pins.size() - before;
        session.drag(Point{{middle[0] + 2, middle[1] + 3, 0}});
        for (int frame = 0; frame < 3; ++frame) session.step();
        if (reach > 12) {
            EXPECT_NEAR(distance(position(session, "c/particle_7_5"), beside + Vec2<double>{{2, 3}}), 0, 0.01);
        }
        session.let_go();
        EXPECT_EQ(world_of(session).pins.size(), before);
        return taken;
    };
    EXPECT_EQ(pinned("", 0), 1U);
    EXPECT_EQ(pinned(R"("pointer": {"grab_radius": 12.5}, )", 12.5), 13U) << "a disc of two threads about the middle";
}

// The tearable curtain: of a row of points 10 px apart, those within 20 px of the way go as fast as the pointer, times
// what the scene says; it holds none, and catches what its way comes near to later.
TEST(Pointer, InClassicModeStrokesWhatItComesNearTo) {
    std::string row;
    for (int i = 0; i < 10; ++i)
        row += (i > 0 ? ", \"p" : "\"p") + std::to_string(i) + "\": {\"at\": [" + std::to_string(10 * i) + ", 0]}";
    const auto scene = [&](const std::string& events) {
        return R"("solver": {"mode": "classic"}, "world": {"damping": 1, "gravity": [0, 0]},
            "pointer": {"grab_radius": 20, "grab_gain": 5}, "figures": [{"name": "f", "particles": {)" +
               row + "}}], " + events + R"("seconds": 1)";
    };
    const auto expect_stroked = [](const Session& session, const std::string& name, double velocity) {
        EXPECT_NEAR(speed(session, name)[1], velocity, 1e-9) << name;
    };
    auto session = play(scene(""));
    const auto id = *find_particle(world_of(session), "f/p1");
    ASSERT_TRUE(session.grab(std::span(&id, 1), Point{{10, 0, 0}}));
    EXPECT_TRUE(session.holds());
    session.drag(Point{{10, 4, 0}});
    session.step();
    for (const auto* near : {"f/p0", "f/p1", "f/p2"}) expect_stroked(session, near, 20);
    expect_stroked(session, "f/p3", 0);
    session.drag(Point{{85, 4, 0}}); // in one step past all others
    session.step();
    EXPECT_NEAR(speed(session, "f/p6")[0], 5 * 75, 1e-9);
    session.let_go();
    EXPECT_FALSE(session.holds());

    auto told = play(scene(
        R"("events": [{"at": 0, "grab": "f/p1", "to": [10, 4], "duration": 1, "within": 20}, {"at": 1, "release": "f/p1"}], )"));
    told.step();
    expect_stroked(told, "f/p2", 20);
    expect_stroked(told, "f/p3", 0);
    told.step();
    expect_stroked(told, "f/p2", 20);
}

// --- events on contact
// ------------------------------------------------------------------------------------------------

/// A ball falls on a ledge and a ball lies there; gravity of 10 m/s^2 downwards, 60 steps a second.
Session falling(const std::string& events) {
    auto document = load(R"({"sinew": 1, "world": {"gravity": [0, -10]}, "colliders": [
        {"name": "ledge", "shape": "half_space"}], "figures": [
        {"name": "ball", "contact": {"figures": true}, "particles": {"p": {"at": [0, 1.1], "radius": 0.1}}},
        {"name": "target", "contact": {"figures": true},
         "particles": {"p": {"at": [0, 0.2], "radius": 0.2, "pinned": true}}}],
        "events": [)" + events +
                             "]}",
                         "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}
std::vector<std::string> log_of(Session& session, double seconds) {
    session.run_until(seconds);
    std::vector<std::string> log;
    for (const auto& event : session.happenings()) log.push_back(event.what + " " + event.where + " " + event.with);
    return log;
}

TEST(ContactRule, BeginsWhereTheBallLands) {
    auto session = falling(R"({"on": {"of": "ball", "with": "target"}, "impulse": "ball", "by": [0, 5]})");
    EXPECT_EQ(log_of(session, 0.3), std::vector<std::string>{});
    EXPECT_EQ(log_of(session, 0.8), (std::vector<std::string>{"begin ball target", "impulse ball "}));
    EXPECT_GT((*position_of(world_of(session), *find_particle(world_of(session), "ball/p")))[1], 0.6) << "thrown up";
    EXPECT_GT(session.happenings()[0].impulse, 0);
    session.restart();
    EXPECT_EQ(log_of(session, 0.8).size(), 2U);
}

TEST(ContactRule, HitsOnlyAboveItsThreshold) {
    for (const std::string above : {"3", "4"}) {
        auto session =
            falling(R"({"on": {"contact": "hit", "of": "target", "above": )" + above + R"(}, "note": "goal"})");
        const auto log = log_of(session, 2);
        if (above == "4") {
            EXPECT_TRUE(log.empty());
            continue;
        }
        EXPECT_EQ(log, (std::vector<std::string>{"hit target ball", "note goal "}));
        EXPECT_NEAR(session.happenings()[0].impulse, std::sqrt(2 * 10 * 0.6), 0.35); // m v, and the weight for a step
    }
}

TEST(ContactRule, EndsWhenThePartsPart) {
    auto session = falling(R"({"at": 1, "impulse": "ball", "by": [0, 4]},
        {"on": {"contact": "end", "of": "ball/p", "with": "target"}, "note": "free", "times": 1})");
    const auto log = log_of(session, 1.3);
    EXPECT_EQ(log, (std::vector<std::string>{"impulse ball ", "end ball/p target", "note free "}));
}

TEST(ContactRule, PersistsAsOftenAsItSays) {
    auto session = falling(
        R"({"at": 1, "on": {"contact": "persist", "of": "ball", "with": "target"}, "note": "on top", "every": 0.5, "times": 3})");
    EXPECT_EQ(log_of(session, 1.1).size(), 2U) << "not before its time";
    EXPECT_EQ(log_of(session, 4).size(), 6U) << "thrice, every half second";
}

TEST(ContactRule, ListensToColliders) {
    auto document =
        load(R"({"sinew": 1, "world": {"gravity": [0, -10]}, "colliders": [{"name": "floor", "shape": "half_space"}],
        "figures": [{"name": "ball", "particles": {"p": {"at": [0, 0.5], "radius": 0.1}}}],
        "events": [{"on": {"contact": "hit", "of": "ball/p", "with": "floor", "above": 2}, "kick": "ball/p", "by": [0, 0]}]})",
             "test.json");
    auto opened = open_scene(document);
    ASSERT_TRUE(opened) << to_text(document.diagnostics);
    Session session(std::move(*opened));
    EXPECT_EQ(log_of(session, 1), (std::vector<std::string>{"hit ball/p floor", "kick ball/p "}));
}

/// Boxes of some masses on each other on a table, at rest; gravity of 10 m/s^2 downwards.
Session stacked(const std::vector<double>& masses, const std::string& contact, const std::string& events) {
    std::string figures;
    for (std::size_t i = 0; i < masses.size(); ++i)
        figures += (i > 0 ? ", " : "") + std::string(R"({"prefab": "box", "name": "box)") + std::to_string(i) +
                   R"(", "at": [0, )" + std::to_string(0.2 + 0.4 * double(i)) +
                   R"(], "width": 0.4, "height": 0.4, "mass": )" + std::to_string(masses[i]) + contact + "}";
    auto document = load(R"({"sinew": 1, "world": {"gravity": [0, -10]}, "solver": {"direct": "off"}, "colliders": [
        {"name": "table", "shape": "half_space"}], "figures": [)" +
                             figures + R"(], "events": [)" + events + "]}",
                         "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}
constexpr auto touching = R"(, "contact": {"figures": true})";

/// Impulse times the steps of a second: a force.
void expect_forces(Session session, double newtons) {
    session.run_until(2.9);
    std::size_t found = 0;
    for (const auto& event : session.happenings()) {
        if (event.what != "persist") continue;
        EXPECT_NEAR(event.impulse * 60, newtons, 0.02 * newtons);
        ++found;
    }
    EXPECT_GT(found, 20U) << "one in each step";
}

TEST(ContactRule, ACrateReportsItsWeightWhateverOfItLies) {
    const std::string rule = R"({"at": 2.5, "on": {"contact": "persist", "of": "box0", "with": "table"}, "note": "x"})";
    for (const std::string contact : {touching, ""}) expect_forces(stacked({2}, contact, rule), 20);
    expect_forces(stacked({2, 3, 4}, touching, rule), 90);
    const std::string corner =
        R"({"at": 2.5, "on": {"contact": "persist", "of": "box0/bottom_left", "with": "table"}, "note": "x"})";
    expect_forces(stacked({2}, touching, corner), 10);
}

TEST(ContactRule, ACrateCarriesAllThatLiesOnIt) {
    const std::string rule = R"({"at": 2.5, "on": {"contact": "persist", "of": "box0", "with": "box1"}, "note": "x"})";
    expect_forces(stacked({2, 3, 4}, touching, rule), 70);
}

// A push tips the box about one corner, and it falls back.
TEST(ContactRule, ACrateThatTipsStillTouches) {
    for (const bool of_corner : {false, true}) {
        const std::string of = of_corner ? "box0/bottom_left" : "box0";
        auto session = stacked({2}, touching,
                               R"({"at": 1, "impulse": "box0/top_left", "by": [2, 0]},
        {"at": 0.9, "on": {"contact": "end", "of": ")" +
                                   of + R"(", "with": "table"}, "note": "x", "times": 1})");
        EXPECT_EQ(log_of(session, 3).size(), of_corner ? 3U : 1U) << "the push alone, or an end and its note too";
    }
}

TEST(ContactRule, ListensToTheBoundsOfTheWorld) {
    for (const std::string mode : {"physical", "classic"}) {
        auto document = load(R"({"sinew": 1, "world": {"gravity": [0, -10], "bounds": {"planes": [{"normal": [0, 1]}]}},
            "solver": {"mode": ")" +
                                 mode + R"("},
            "figures": [{"name": "ball", "particles": {"p": {"at": [0, 0.5], "radius": 0.1}}}],
            "events": [{"on": {"of": "ball", "with": "bounds"}, "note": "down"},
                       {"on": {"of": "ball", "with": "bounds", "contact": "hit", "above": 2}, "note": "hard"},
                       {"at": 1, "impulse": "ball", "by": [0, 4]},
                       {"at": 1, "on": {"of": "ball", "contact": "end"}, "note": "up", "times": 1}]})",
                             "test.json");
        auto opened = open_scene(document);
        ASSERT_TRUE(opened) << to_text(document.diagnostics);
        Session session(std::move(*opened));
        const auto log = log_of(session, 1.2);
        ASSERT_GE(log.size(), 2U) << mode;
        EXPECT_EQ(log[0], "begin ball bounds") << mode;
        EXPECT_EQ(log[1], "note down ") << mode;
        if (mode == "classic") continue; // without impulses, and a ball touches only while it sinks in
        EXPECT_EQ(log, (std::vector<std::string>{"begin ball bounds", "note down ", "hit ball bounds", "note hard ",
                                                 "impulse ball ", "end ball bounds", "note up "}));
    }
}

TEST(ContactRule, IsChecked) {
    const std::string begin = R"({"sinew": 1, "figures": [{"prefab": "rope"}], "events": [)";
    EXPECT_NE(told(begin + R"({"note": "x"}]})").find("needs a time"), std::string::npos);
    EXPECT_NE(told(begin + R"({"on": {"of": "rop"}, "note": "x"}]})").find("as figure/name"), std::string::npos);
    EXPECT_NE(told(begin + R"({"on": {"of": "rope", "with": "flor"}, "note": "x"}]})").find("no collider or figure"),
              std::string::npos);
    EXPECT_NE(told(begin + R"({"on": {"contact": "kiss", "of": "rope"}, "note": "x"}]})").find("persist"),
              std::string::npos);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

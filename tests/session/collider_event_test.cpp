#include "sinew/scene/reader.h"
#include "sinew/session/session.h"
#include "sinew/world/edit.h"

#include <gtest/gtest.h>

/// Events that change colliders and take figures away.
namespace sinew::SINEW_TEST_FILE {
namespace {

using World2 = World<2, double>;

Session play(const std::string& rest) {
    auto document = load(R"({"sinew": 1, "world": {"gravity": [0, -10]}, "solver": {"precision": "double"},
                            "figures": [{"name": "b", "particles": {"p": {"at": [0, 0.1], "radius": 0.1}}}], )" +
                             rest + "}",
                         "test.json");
    auto opened = open_scene(document);
    EXPECT_TRUE(opened) << to_text(document.diagnostics);
    return Session(std::move(*opened));
}
std::string told(const std::string& rest) {
    auto document = load(R"({"sinew": 1, )" + rest + "}", "test.json");
    EXPECT_FALSE(open_scene(document));
    return to_text(document.diagnostics);
}
const World2& world_of(const Session& session) {
    return std::get<World2>(session.world());
}
Vec2<double> ball(const Session& session) {
    return *position_of(world_of(session), *find_particle(world_of(session), "b/p"));
}

constexpr auto trap = R"("colliders": [{"name": "trap", "shape": "box", "size": [2, 0.2], "at": [0, -0.1]}], )";

// Free fall from the moment at which the door opens; discrete: h/2 more for the substep of 1 ms.
TEST(TrapDoor, LetsFallWhatLiesOnIt) {
    auto session = play(std::string(trap) + R"("events": [{"at": 1, "collider": "trap", "enabled": false}])");
    session.run_until(1);
    EXPECT_NEAR(ball(session)[1], 0.1, 1e-4);
    session.run_until(1.5);
    EXPECT_NEAR(ball(session)[1], 0.1 - 1.25, 0.02);
}
TEST(TrapDoor, ClosesAgain) {
    auto session = play(std::string(trap) + R"("events": [{"at": 1, "collider": "trap", "enabled": false},
                                                          {"at": 1.05, "collider": "trap", "enabled": true}])");
    session.run_until(2);
    EXPECT_NEAR(ball(session)[1], 0.1, 1e-3);
}
TEST(TrapDoor, IsGoneAfterItsRemoval) {
    auto session = play(std::string(trap) + R"("events": [{"at": 1, "remove": ["trap"]}])");
    session.run_until(1.5);
    EXPECT_TRUE(world_of(session).colliders.empty());
    EXPECT_LT(ball(session)[1], -1);
}
TEST(ColliderEvent, LiftsWhatLiesOnIt) {
    auto session =
        play(std::string(trap) + R"("events": [{"at": 1, "collider": "trap", "to": [0, 0.9], "duration": 2}])");
    session.run_until(2);
    EXPECT_NEAR(ball(session)[1], 0.6, 0.02);
    session.run_until(4);
    EXPECT_NEAR(ball(session)[1], 1.1, 1e-3);
    session.restart();
    session.run_until(0.5);
    EXPECT_NEAR(ball(session)[1], 0.1, 1e-3);
}
TEST(ColliderEvent, SetsABeltRunning) {
    auto session =
        play(std::string(trap) + R"("events": [{"at": 0, "collider": "trap", "surface_velocity": [0.5, 0]}])");
    session.run_until(1);
    // Friction of 0.5 turns the disc, too: it rolls backwards on the belt at a third of its speed from 1/30 s on.
    EXPECT_NEAR(ball(session)[0], 0.5 / 3 * (1 - 1.0 / 60), 0.001);
}
TEST(RemoveEvent, TakesAFigureAway) {
    auto session = play(R"("events": [{"at": 1, "remove": ["b"]}])");
    session.run_until(2);
    EXPECT_EQ(world_of(session).particles.size(), 0U);
}
// A tap: a ball every half a second.
TEST(AddEvent, AddsFiguresAgainAndAgain) {
    auto session = play(R"("events": [{"every": 0.5, "times": 4, "add": "b", "to": [3, 0], "velocity": [1, 0]}])");
    session.run_until(1.4);
    EXPECT_EQ(world_of(session).particles.size(), 4U);
    const auto first = find_particle(world_of(session), "b_1/p"), third = find_particle(world_of(session), "b_3/p");
    ASSERT_TRUE(first && third);
    EXPECT_NEAR((*position_of(world_of(session), *first))[0], 4.4, 0.02);
    EXPECT_NEAR((*position_of(world_of(session), *third))[0], 3.4, 0.02);
    EXPECT_NEAR((*position_of(world_of(session), *third))[1], 0.1 - 5 * 0.16, 0.03);
    session.run_until(5);
    EXPECT_EQ(world_of(session).particles.size(), 5U);
    session.restart();
    EXPECT_EQ(world_of(session).particles.size(), 1U);
}
TEST(ColliderEvent, MistakesHaveAPlace) {
    EXPECT_NE(told(std::string(trap) + R"("events": [{"at": 1, "collider": "trapp", "enabled": false}])").find("trap"),
              std::string::npos);
    EXPECT_NE(told(R"("colliders": [{"name": "a", "shape": "sphere", "motion": {"spin": 10}}],
                      "events": [{"at": 1, "collider": "a", "turn": 10}])")
                  .find("motion of its own"),
              std::string::npos);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

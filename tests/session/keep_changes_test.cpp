#include "sinew/scene/reader.h"
#include "sinew/session/keep_changes.h"
#include "sinew/session/session.h"
#include "sinew/world/edit.h"
#include "sinew/world/environment.h"

#include "tests/session/positions.h"

#include <array>
#include <gtest/gtest.h>
#include <string>
#include <vector>

/// An edit of the scene, and all that calls and events have changed before.
namespace sinew::SINEW_TEST_FILE {
namespace {

Opened opened(const std::string& damping, const std::string& rest) {
    auto document =
        load(R"({"sinew": 1, "world": {"gravity": [0, -10], "damping": )" + damping + "}, " + rest + "}", "test.json");
    auto scene = open_scene(document);
    EXPECT_TRUE(scene) << to_text(document.diagnostics);
    return std::move(*scene);
}

/// A session of a scene that runs for a while, and goes on with another damping. Nothing is lost.
Session edited(const std::string& rest, double seconds) {
    Session session(opened("0", rest));
    session.run_until(seconds);
    EXPECT_EQ(session.become(opened("0.001", rest).scene), "");
    return session;
}

double height(const Session& session, std::string_view name) {
    return (*position_of(world_of(session), *find_particle(world_of(session), name)))[1];
}

TEST(KeptChanges, FiguresThatEventsAddAndRemoveStayAsTheyAre) {
    auto session =
        edited(R"("figures": [{"prefab": "ball", "name": "a"}, {"prefab": "ball", "name": "b", "at": [3, 0]}],
        "events": [{"at": 0.1, "add": "a"}, {"at": 0.2, "remove": ["b"]}])",
               0.5);
    const auto& world = world_of(session);
    EXPECT_FALSE(find_figure(world, "b"));
    ASSERT_EQ(world.figures.size() - world.unused_figures, 2U) << "the ball and its copy";
    const auto before = world.particles.position;
    session.step();
    ASSERT_EQ(world_of(session).particles.size(), before.size());
    for (Row row = 0; row < before.size(); ++row)
        EXPECT_LT(world_of(session).particles.position[row][1], before[row][1]);
}

TEST(KeptChanges, ReleasedParticleStaysReleased) {
    auto session = edited(
        R"("figures": [{"prefab": "rope", "at": [0, 5]}], "events": [{"at": 0.1, "release": "rope/start"}])", 0.5);
    EXPECT_LT(height(session, "rope/start"), 4.5);
    const double before = height(session, "rope/start");
    session.run_until(0.6);
    EXPECT_LT(height(session, "rope/start"), before - 0.3);
}

/// A winch of 1 m/s has drawn in half a metre of three, and goes on from there.
TEST(KeptChanges, WinchGoesOnWhereItIs) {
    auto session = edited(R"("figures": [{"name": "f", "particles": {"a": {"at": [0, 5], "pinned": true},
        "b": {"at": [0, 2]}}, "constraints": [{"name": "cord", "between": ["a", "b"], "drive": {"speed": -1}}]}])",
                          0.5);
    EXPECT_NEAR(height(session, "f/b"), 2.5, 0.05);
    session.run_until(1);
    EXPECT_NEAR(height(session, "f/b"), 3, 0.05);
}

/// A weight of a call hangs on a rope of the scene: an edit of another figure keeps both, one of the rope's form tells.
TEST(KeptChanges, ConstraintThatCannotGoOnIsTold) {
    const auto scene = [](int segments, double mass) {
        return R"("figures": [{"prefab": "rope", "at": [0, 5], "segments": )" + std::to_string(segments) +
               R"(}, {"prefab": "ball", "at": [3, 0], "mass": )" + std::to_string(mass) + "}]";
    };
    Session session(opened("0", scene(4, 1)));
    auto& world = std::get<World<2, double>>(session.world());
    const auto weight = add_particle(world, {.position = {{1, 3}}, .mass = 2});
    const auto cord = add<Distance>(world, {*find_particle(world, "rope/end"), weight});
    session.run_until(0.3);
    EXPECT_EQ(session.become(opened("0", scene(4, 5)).scene), "");
    EXPECT_TRUE(constraint_state(world_of(session), *cord));
    EXPECT_TRUE(position_of(world_of(session), weight));
    EXPECT_EQ(session.become(opened("0", scene(6, 5)).scene), "a constraint holds \"rope\", which begins anew");
    EXPECT_FALSE(constraint_state(world_of(session), *cord));
    EXPECT_TRUE(position_of(world_of(session), weight)) << "the rest goes on";
}

/// An edit makes all rows anew; each pin and constraint is found by its id, whatever the order.
TEST(KeptChanges, IdsAreFoundInAnyOrder) {
    const Id<ConstraintTag> first{0, 9}, second{1, 2};
    Renamed renamed{.pins = {{{{7, 1}, {1, 1}}}, {{{2, 5}, {2, 2}}}, {{{2, 4}, {3, 3}}}},
                    .constraints = {{{{1, first}, {1, second}}}, {{{0, second}, {0, first}}}}};
    renamed.sort();
    const auto of = [&](auto id) {
        renamed.rename(id);
        return id;
    };
    EXPECT_EQ(of(PinId{7, 1}), (PinId{1, 1}));
    EXPECT_EQ(of(PinId{2, 5}), (PinId{2, 2}));
    EXPECT_EQ(of(PinId{2, 4}), (PinId{3, 3}));
    EXPECT_EQ(of(PinId{2, 6}), (PinId{2, 6})) << "unknown";
    EXPECT_EQ(of(ConstraintId{1, first}), (ConstraintId{1, second}));
    EXPECT_EQ(of(ConstraintId{0, second}), (ConstraintId{0, first}));
    EXPECT_EQ(of(ConstraintId{0, first}), (ConstraintId{0, first}));
}

/// A force that the edit takes away or adds leaves the ids of the others alone; so does one that a call has added.
TEST(KeptChanges, ForcesAreKnownByWhatTheyAre) {
    const auto with = [](const std::string& forces) {
        auto document = load(R"({"sinew": 1, "world": {"forces": [)" + forces + "]}}", "test.json");
        auto opened = open_scene(document);
        EXPECT_TRUE(opened) << to_text(document.diagnostics);
        return std::move(*opened);
    };
    const std::string drag = R"({"force": "drag", "strength": 1})", calm = R"({"force": "wind", "velocity": [0, 0]})";
    Session session(with(drag + ", " + calm));
    auto& world = std::get<World<2, double>>(session.world());
    const auto first = world.forces.id_of(1), second = world.forces.id_of(2);
    const auto added = add_force(world, Drag<2, double>{3});
    std::get<Wind<2, double>>(*world.forces.find(second)).velocity = {{5, 0}};
    EXPECT_EQ(session.become(with(calm).scene), "");
    EXPECT_FALSE(world.forces.find(first));
    EXPECT_EQ((std::get<Wind<2, double>>(*world.forces.find(second)).velocity[0]), 5);
    EXPECT_EQ((std::get<Drag<2, double>>(*world.forces.find(added)).strength), 3);
    EXPECT_EQ(session.become(with(drag + ", " + calm).scene), "");
    ASSERT_EQ(world.forces.size(), 4U);
    EXPECT_EQ(world.forces.row_of(second), Row(2));
    EXPECT_EQ(world.forces.row_of(added), Row(3));
    EXPECT_NE(world.forces.id_of(1), first);
    EXPECT_EQ(session.become(with("").scene), "");
    ASSERT_EQ(world.forces.size(), 2U);
    EXPECT_EQ(world.forces.row_of(added), Row(1));
}

/// Rows get the ids of another table, and new ones differ from all of them.
TEST(KeptChanges, TableTakesOverIds) {
    struct Tag;
    HandleMap<Tag> old, fresh;
    std::vector<Id<Tag>> ids;
    for (int i = 0; i < 5; ++i) ids.push_back(old.append());
    old.erase(std::array<char, 5>{0, 1, 0, 0, 0});
    for (int i = 0; i < 4; ++i) fresh.append();
    fresh.take_over(std::array{ids[4], Id<Tag>{}, ids[0], ids[2]});
    EXPECT_TRUE(fresh.is_sound());
    EXPECT_EQ(fresh.find(ids[4]), Row(0));
    EXPECT_EQ(fresh.find(ids[0]), Row(2));
    EXPECT_EQ(fresh.find(ids[2]), Row(3));
    EXPECT_FALSE(fresh.find(ids[1]) || fresh.find(ids[3]));
    const auto own = fresh.id_of(1), next = fresh.append();
    EXPECT_EQ(fresh.find(own), Row(1));
    EXPECT_EQ(fresh.find(next), Row(4));
    EXPECT_NE(own.generation, ids[0].generation);
    EXPECT_TRUE(fresh.is_sound());
    fresh.erase(std::array<char, 5>{1, 0, 0, 1, 0});
    EXPECT_TRUE(fresh.is_sound());
    EXPECT_EQ(fresh.find(ids[0]), Row(1));
}

TEST(KeptChanges, TableOfEqualIdsStaysPlain) {
    struct Tag;
    HandleMap<Tag> old, fresh;
    std::vector<Id<Tag>> ids;
    for (int i = 0; i < 3; ++i) ids.push_back(old.append()), fresh.append();
    fresh.take_over(ids);
    EXPECT_TRUE(fresh.is_sound());
    for (Row row = 0; row < 3; ++row) EXPECT_EQ(fresh.id_of(row), ids[row]);
    const auto next = fresh.append();
    EXPECT_EQ(fresh.find(next), Row(3));
    EXPECT_NE(next.generation, ids[0].generation);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#include "sinew/math/random.h"
#include "sinew/session/session_snapshot.h"
#include "sinew/world/measure.h"

#include "tests/scene/scene_runs.h"
#include "tests/thorough.h"

/// A running session as bytes, and back.
namespace sinew::SINEW_TEST_FILE {
namespace {

std::uint64_t hash_of(const Session& session) {
    return std::visit([](const auto& world) { return state_hash(world); }, session.world());
}

/// Opens the text of a scene of the catalogue.
SceneOpener opener() {
    return [](const std::string& text, const std::string&) {
        auto document = load(text, "snapshot");
        auto opened = open_scene(document, {}, models_beside(std::filesystem::path(test::scenes_dir()) / "any.json"));
        EXPECT_TRUE(opened) << to_text(document.diagnostics);
        return opened;
    };
}

std::optional<Session> copy_by_bytes(const Session& session) {
    SnapshotError error;
    const auto bytes = save(session);
    auto restored = session_of(bytes, opener(), error);
    EXPECT_TRUE(restored) << error.text();
    if (!restored) return restored;
    EXPECT_EQ(save(*restored), bytes) << "saving what was restored gives the same bytes";
    return restored;
}

struct SessionSnapshots : ::testing::TestWithParam<std::string> {};

// In flight, in contact, torn, asleep: at random steps of every scene, with the pointer at work.
TEST_P(SessionSnapshots, HaveTheSameFutureAtAnyStep) {
    for (const auto* mode : {"physical", "classic"})
        for (const auto* precision : {"double", "float"}) {
            auto session = open(GetParam(), mode, precision);
            ASSERT_TRUE(session);
            for (int round = 0; round < few_or_many(2, 6); ++round) {
                const auto seed = std::uint64_t(round) + 1;
                for (auto left = random::whole(1, 30, seed, 1, 2); left > 0; --left) session->step();
                if (round % 2 == 1) session->point_at(session->focus()[0]);
                auto restored = copy_by_bytes(*session);
                ASSERT_TRUE(restored);
                for (int i = 0; i < 4; ++i) {
                    ASSERT_EQ(hash_of(*restored), hash_of(*session)) << mode << ", " << precision << ", step " << i;
                    session->step();
                    restored->step();
                }
                ASSERT_EQ(restored->happening_count(), session->happening_count());
                ASSERT_EQ(restored->report().energy_lost, session->report().energy_lost);
            }
        }
}
INSTANTIATE_TEST_SUITE_P(Every, SessionSnapshots, ::testing::ValuesIn(scene_names()),
                         [](const auto& test) { return test.param; });

// A grab goes on, and lets go of what it held.
TEST(SessionSnapshot, HoldsThePointersGrab) {
    auto session = open("ragdoll", "physical");
    ASSERT_TRUE(session);
    for (int i = 0; i < 20; ++i) session->step();
    const auto [id, position] = std::visit(
        [](const auto& world) {
            Point at;
            for (int k = 0; k < std::decay_t<decltype(world)>::dimension; ++k)
                at[k] = double(world.particles.position[3][k]);
            return std::pair(world.particles.handles.id_of(3), at);
        },
        session->world());
    ASSERT_TRUE(session->grab(std::array{id}, position));
    session->step();
    auto restored = copy_by_bytes(*session);
    ASSERT_TRUE(restored && restored->holds());
    auto there = position;
    there[0] += 1;
    for (auto* one : {&*session, &*restored}) {
        one->drag(there);
        for (int i = 0; i < 5; ++i) one->step();
        one->let_go();
        for (int i = 0; i < 5; ++i) one->step();
    }
    EXPECT_EQ(hash_of(*restored), hash_of(*session));
}

TEST(SessionSnapshot, OfAnotherSceneIsRefused) {
    auto session = open("ragdoll", "physical");
    ASSERT_TRUE(session);
    const auto bytes = save(*session);
    SnapshotError error;
    EXPECT_FALSE(session_of(
        bytes, [](const auto&, const auto&) { return std::optional<Opened>(); }, error));
    const auto empty = [](const std::string&, const std::string&) {
        auto document = load(R"({"sinew": 1, "dimension": 3})", "empty");
        return open_scene(document);
    };
    EXPECT_FALSE(session_of(bytes, empty, error));
    EXPECT_EQ(error.what, "a world of another dimension or precision");
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

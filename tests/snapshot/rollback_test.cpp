#include "sinew/prefab/prefabs.h"
#include "sinew/prefab/steer.h"
#include "sinew/prefab/walk.h"
#include "sinew/simulation.h"
#include "sinew/snapshot/rollback.h"
#include "sinew/world/environment.h"

#include "tests/random_calls.h"
#include "tests/thorough.h"

#include <chrono>
#include <deque>

/// Going back to earlier moments of a world.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Rollbacks : ::testing::Test {};
TYPED_TEST_SUITE(Rollbacks, Everywhere, Names);

TYPED_TEST(Rollbacks, LeadToTheSameFutureAfterAnyCalls) {
    using Real = typename TypeParam::Real;
    constexpr std::size_t moments = 8;
    for (std::uint64_t seed = 0; seed < std::uint64_t(few_or_many(6, 60)); ++seed) {
        RandomCalls<typename TypeParam::World> calls(seed);
        Rollback<TypeParam::dimension, Real> ring(moments);
        std::deque<typename TypeParam::World> copies;
        for (int step_number = 0; step_number < 25; ++step_number) {
            for (int i = calls.below(3); i > 0; --i) calls.call();
            ring.keep(calls.world);
            copies.push_front(calls.world);
            if (copies.size() > moments) copies.pop_back();
            step(calls.world, Real(1.0 / 60));
            if (calls.below(4) > 0) continue;
            const auto back = std::size_t(calls.below(int(ring.size())));
            ASSERT_TRUE(ring.go_back(calls.world, back));
            copies.erase(copies.begin(), copies.begin() + std::ptrdiff_t(back));
            ASSERT_EQ(state_hash(calls.world), state_hash(copies.front())) << "seed " << seed;
            for (int i = 0; i < 2; ++i) {
                step(calls.world, Real(1.0 / 60));
                step(copies.front(), Real(1.0 / 60));
                ASSERT_EQ(state_hash(calls.world), state_hash(copies.front())) << "seed " << seed;
            }
            ring.go_back(calls.world, 0);
            copies.front() = calls.world;
        }
    }
}

TEST(Rollback, GoesBackNoFurtherThanItHolds) {
    World<2, double> world;
    add_particle(world, {.velocity = {1, 0}});
    Solver<2, double> solver;
    Rollback<2, double> ring(3);
    EXPECT_FALSE(ring.go_back(world, 0));
    for (int i = 0; i < 10; ++i) ring.keep(world), solver.step(world, 1);
    EXPECT_EQ(ring.size(), 3U);
    EXPECT_FALSE(ring.go_back(world, 3));
    EXPECT_EQ(world.steps, 10U);
    ASSERT_TRUE(ring.go_back(world, 2));
    EXPECT_EQ(world.steps, 7U);
    EXPECT_EQ(ring.size(), 1U) << "later moments are forgotten";
}

// Steering changes how heavy a wheel is to turn, and how a character rubs: fixed fields, which come back all the same.
TEST(Rollback, GoesBackToWheelsAndFeetAsTheyWere) {
    Simulation<2, double> simulation;
    auto& world = simulation.world;
    set_gravity(world, {0, -9.81});
    add_plane(world, {.normal = {0, 1}, .offset = 0, .friction = 0.8});
    const auto car = build(world, Car{}, "car").figure;
    const auto hero = build(world, Character{}, "hero", Placement<2, double>{.at = {9, 0}}).figure;
    Rollback<2, double> ring(40);
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < 40; ++i) {
        ring.keep(world);
        hashes.push_back(state_hash(world));
        const Controls controls{.along = i % 7 < 4 ? 1.0 : 0.0, .jump = i % 5 == 4};
        steer(world, car, Car{}, controls, 1.0 / 60);
        walk(world, hero, Character{}, controls, 1.0 / 60);
        simulation.step(1.0 / 60);
    }
    for (; ring.size() > 3; hashes.resize(ring.size())) {
        ASSERT_TRUE(ring.go_back(world, 2));
        ASSERT_EQ(state_hash(world), hashes[ring.size() - 1]) << ring.size();
    }
}

// A moment shares nothing with the one before after teleports, and where steps are taken in between.
TEST(Rollback, KeepsPositionsThatTheMomentBeforeHasNot) {
    Simulation<3, float> simulation;
    auto& world = simulation.world;
    set_gravity(world, {0, -9.81F, 0});
    build(world, Cloth{.columns = 8, .rows = 8}, "cloth");
    std::deque<std::uint64_t> hashes;
    Rollback<3, float> ring(4);
    for (int i = 0; i < 12; ++i) {
        for (int k = 0; k < 1 + i % 3; ++k) simulation.step(1.0F / 60);
        if (i % 4 == 1) teleport(world, FigureIndex(0), {0, 1, 0});
        ring.keep(world);
        hashes.push_back(state_hash(world));
    }
    for (const std::size_t back : {1U, 1U}) {
        ASSERT_TRUE(ring.go_back(world, back));
        hashes.pop_back();
        ASSERT_EQ(state_hash(world), hashes.back());
    }
}

/// A push of a player's ragdoll at a step.
struct Push {
    int number = 0;
    int step = 0;
    FigureIndex figure = 0;
    Vec2<float> by{};
};

struct Game {
    Simulation<2, float> simulation;
    Game() {
        set_gravity(simulation.world, {0, -9.81F});
        add_plane(simulation.world, {.normal = {0, 1}, .offset = 0, .friction = 0.5F});
        for (int player = 0; player < 2; ++player)
            build(simulation.world, Ragdoll{}, player == 0 ? "one" : "other",
                  Placement<2, float>{.at = {float(2 * player), 2}});
    }
    void step(const std::vector<Push>& pushes, int number) {
        for (const auto& push : pushes)
            if (push.step == number)
                apply_impulse(simulation.world, simulation.world.figures[push.figure].particles[0], push.by);
        simulation.step(1.0F / 60);
    }
};

// Two players, each sees the other's pushes late and out of order, guesses that there are none, and corrects itself.
TEST(Rollback, MakesTwoPlayersOverALateLinkAgree) {
    constexpr int steps = 120, latest = 9;
    std::vector<Push> pushes;
    for (int i = 0; i < 40; ++i)
        pushes.push_back({i,
                          int(random::whole(0, steps - latest - 1, 3, 0, std::uint64_t(i))),
                          FigureIndex(i % 2),
                          {float(random::symmetric<double>(4, 0, std::uint64_t(i))), 2}});
    Game honest;
    for (int i = 0; i < steps; ++i) honest.step(pushes, i);
    for (const FigureIndex own : {0U, 1U}) {
        Game guess;
        Rollback<2, float> ring(latest + 1);
        std::vector<Push> known;
        for (int now = 0; now < steps; ++now) {
            int first = now; // step from which all has to be done again
            for (std::size_t i = 0; i < pushes.size(); ++i) {
                const int delay = pushes[i].figure == own ? 0 : int(random::whole(1, latest, 5, 0, i));
                if (pushes[i].step + delay != now) continue;
                known.push_back(pushes[i]);
                first = std::min(first, pushes[i].step);
            }
            std::stable_sort(known.begin(), known.end(), [&](const Push& a, const Push& b) {
                return a.number < b.number; // pushes of one step in one order
            });
            const bool is_right = first == now || ring.go_back(guess.simulation.world, std::size_t(now - 1 - first));
            ASSERT_TRUE(is_right);
            for (int i = first; i <= now; ++i) {
                if (i > first || first == now) ring.keep(guess.simulation.world);
                guess.step(known, i);
            }
        }
        EXPECT_EQ(state_hash(guess.simulation.world), state_hash(honest.simulation.world)) << "player " << own;
    }
}

/// A hundred ragdolls in rows above the ground, each turned another way.
Simulation<2, float> hundred_ragdolls() {
    Simulation<2, float> simulation;
    set_gravity(simulation.world, {0, -9.81F});
    add_plane(simulation.world, {.normal = {0, 1}, .offset = -1, .friction = 0.5F});
    for (int i = 0; i < 100; ++i)
        build(simulation.world, Ragdoll{}, "ragdoll" + std::to_string(i),
              Placement<2, float>{.at = {0.7F * float(i % 10), 2.0F * float(i / 10)}, .turn = 0.3 * i});
    return simulation;
}

// In flight, in collisions, and in a heap.
TEST(Rollback, OfAHundredRagdollsIsSmallAndQuick) {
    auto simulation = hundred_ragdolls();
    Rollback<2, float> ring(8);
    using Clock = std::chrono::steady_clock;
    for (const int steps : {10, 60, 180}) {
        while (int(simulation.world.steps) < steps) ring.keep(simulation.world), simulation.step(1.0F / 60);
        double keeping = 1e9, going_back = 1e9;
        std::size_t bytes = 0;
        for (int i = 0; i < 40; ++i) {
            const auto begin = Clock::now();
            ring.keep(simulation.world);
            const auto kept = Clock::now();
            bytes = ring.bytes();
            ASSERT_TRUE(ring.go_back(simulation.world, 0));
            const std::chrono::duration<double, std::micro> first = kept - begin, second = Clock::now() - kept;
            keeping = std::min(keeping, first.count()), going_back = std::min(going_back, second.count());
            simulation.step(1.0F / 60);
        }
        std::printf("100 ragdolls: %zu particles, %zu bytes, kept in %.0f us, back in %.0f us\n",
                    simulation.world.particles.size(), bytes, keeping, going_back);
        EXPECT_LT(bytes, 40'000U);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

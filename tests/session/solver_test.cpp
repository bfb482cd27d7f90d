#include "sinew/math/random.h"
#include "sinew/prefab/prefabs.h"
#include "sinew/simulation.h"
#include "sinew/world/colliders.h"
#include "sinew/world/environment.h"
#include "sinew/world/measure.h"

#include "tests/scene/scene_runs.h"
#include "tests/thorough.h"

#include <array>
#include <thread>
#include <vector>

/// A solver follows from its world: one thrown away at any time, or another beside it, changes no bit.
namespace sinew::SINEW_TEST_FILE {
namespace {

std::uint64_t hash_of(const Session& session) {
    return std::visit([](const auto& world) { return state_hash(world); }, session.world());
}

TEST(Solvers, CanBeThrownAwayAtAnyStepOfEveryScene) {
    const int steps = few_or_many(40, 400);
    for (const auto& name : scene_names())
        for (const auto* mode : {"physical", "classic"}) {
            auto kept = open(name, mode), renewed = open(name, mode);
            ASSERT_TRUE(kept && renewed) << name;
            for (int i = 0; i < steps; ++i) {
                if (random::whole(0, 7, 3, 0, std::uint64_t(i)) == 0) renewed->set_options({.threads = 1 + i % 3});
                kept->step();
                renewed->step();
                ASSERT_EQ(hash_of(*kept), hash_of(*renewed)) << name << ", " << mode << ", step " << i;
            }
        }
}

Simulation<2> rope_in_wind(int threads) {
    Simulation<2> simulation{{}, Solver<2, double>({.threads = threads})};
    set_gravity(simulation.world, {0, -9.81});
    add_wind(simulation.world, {.velocity = {3, 0}, .strength = 0.1});
    add_plane(simulation.world, {.normal = {0, 2}, .offset = -2, .friction = 0.5});
    build(simulation.world, Rope{.length = 2, .segments = 20, .weight = 5}, "rope");
    return simulation;
}

TEST(Solvers, OfOneWorldTakeTurns) {
    auto together = rope_in_wind(1), alone = rope_in_wind(1), other = rope_in_wind(2);
    Solver<2, double> second({.threads = 2});
    for (int i = 0; i < 60; ++i) {
        alone.step(1.0 / 60);
        other.step(1.0 / 60);
        (i % 3 == 0 ? together.solver : second).step(together.world, 1.0 / 60);
        if (i % 7 == 0) second.step(other.world, 1.0 / 60), alone.step(1.0 / 60); // and one solver serves two worlds
    }
    EXPECT_EQ(state_hash(alone.world), state_hash(other.world));
    EXPECT_NE(state_hash(together.world), state_hash(other.world));
    for (int i = 0; i < 9; ++i) second.step(together.world, 1.0 / 60);
    EXPECT_EQ(state_hash(together.world), state_hash(other.world)) << "69 steps each";
}

/// Adds a figure of 25 particles.
void add_cloth_or_rope(World<3, double>& world, bool cloth) {
    const FigureIndex figure = cloth ? build(world, Cloth{.columns = 5, .rows = 5}, "cloth").figure
                                     : build(world, Rope{.length = 2, .segments = 24}, "rope").figure;
    world.figures[figure].internal_damping = cloth ? 2 : 0.5;
    set_contact(world, figure, {.figures = true});
}

/// All that a solver lists: wind on areas and lines, bodies that damp, sleep, touch walls and each other.
Simulation<3> cloth_and_rope(bool cloth_first) {
    Simulation<3> simulation{{}, Solver<3, double>({.threads = 1})};
    auto& world = simulation.world;
    set_gravity(world, {0, -9.81, 0});
    add_wind(world, {.velocity = {3, 0, 1}, .density = 1.2});
    add_plane(world, {.normal = {0, 1, 0}, .offset = -0.5, .friction = 0.5});
    world.settings.sleep = {.speed = 0.05, .delay = 0.1};
    for (const bool cloth : {cloth_first, !cloth_first}) add_cloth_or_rope(world, cloth);
    return simulation;
}

TEST(Solvers, OneServesTwoWorldsOfAsManyParticles) {
    std::array alone{cloth_and_rope(true), cloth_and_rope(false)}, served{cloth_and_rope(true), cloth_and_rope(false)};
    Solver<3, double> solver({.threads = 1});
    for (int i = 0; i < 60; ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            alone[k].step(1.0 / 60);
            solver.step(served[k].world, 1.0 / 60);
            ASSERT_EQ(state_hash(alone[k].world), state_hash(served[k].world)) << k << ", step " << i;
        }
}

TEST(Solvers, PreparedBetweenAnEditAndAStepChangeNothing) {
    auto prepared = cloth_and_rope(true), stepped = cloth_and_rope(true);
    for (int i = 0; i < 90; ++i) {
        if (i % 20 == 19) // one goes, and comes back behind the other
            for (auto* world : {&prepared.world, &stepped.world}) {
                const bool cloth = i % 40 == 19;
                ASSERT_TRUE(remove_figure(*world, find_figure(*world, cloth ? "cloth" : "rope").value()));
                add_cloth_or_rope(*world, cloth);
            }
        if (i % 2 == 1) prepared.solver.prepare(prepared.world);
        prepared.step(1.0 / 60);
        stepped.step(1.0 / 60);
        ASSERT_EQ(state_hash(prepared.world), state_hash(stepped.world)) << "step " << i;
    }
}

// Threads and instruction sets are options of each solver: two at the same time do not disturb each other.
TEST(Solvers, OfDifferentOptionsRunSideBySide) {
    const auto cloth = [](const SolverOptions& options) {
        Simulation<3, float> simulation{{}, Solver<3, float>(options)};
        set_gravity(simulation.world, {0, -9.81F, 0});
        build(simulation.world, Cloth{.columns = 64, .rows = 64}, "cloth");
        for (int i = 0; i < few_or_many(10, 60); ++i) simulation.step(1.0F / 60);
        return state_hash(simulation.world);
    };
    const auto alone = cloth({.threads = 1});
    std::array<std::uint64_t, 3> found{};
    const std::array<SolverOptions, 3> options{
        {{.threads = 1, .simd = Simd::one}, {.threads = 3, .simd = best_simd()}, {.threads = 2, .simd = best_simd()}}};
    std::vector<std::thread> beside;
    for (std::size_t i = 0; i < found.size(); ++i) beside.emplace_back([&, i] { found[i] = cloth(options[i]); });
    for (auto& thread : beside) thread.join();
    for (const auto hash : found) EXPECT_EQ(hash, alone);
}

TEST(Solvers, FollowAWorldThatIsReplaced) {
    auto simulation = rope_in_wind(1);
    const auto begun = simulation;
    for (int i = 0; i < 30; ++i) simulation.step(1.0 / 60);
    const auto hash = state_hash(simulation.world);
    simulation.world = begun.world;
    for (int i = 0; i < 30; ++i) simulation.step(1.0 / 60);
    EXPECT_EQ(state_hash(simulation.world), hash);
    World<2, double> moved = std::move(simulation.world);
    simulation.world = begun.world;
    simulation.world = std::move(moved);
    EXPECT_EQ(state_hash(simulation.world), hash);
    simulation.step(1.0 / 60);
    simulation.world = {};
    simulation.step(1.0 / 60);
    EXPECT_EQ(simulation.world.steps, 1U);
}

TEST(Environment, HasGravityAirAndWallsByName) {
    World<3, float> world;
    set_gravity(world, {0, -1, 0});
    set_gravity(world, {0, -9.81F, 0});
    ASSERT_EQ(world.forces.size(), 1U);
    EXPECT_EQ(std::get<0>(world.forces[0]).acceleration[1], -9.81F);
    add_plane(world, {.normal = {0, 3, 4}, .offset = 10});
    ASSERT_EQ(world.bounds.size(), 1U);
    EXPECT_FLOAT_EQ(world.bounds[0].offset, 2);
    EXPECT_FLOAT_EQ(norm(world.bounds[0].normal), 1);
    add_plane(world, {.offset = 10});
    EXPECT_EQ(world.bounds.size(), 1U) << "no direction, no plane";
    set_bounds(world, {-1, -2, -3}, {1, 2, 3}, 0.5F, 0.25F);
    ASSERT_EQ(world.bounds.size(), 6U);
    EXPECT_FLOAT_EQ(world.bounds[5].offset, -3);
    EXPECT_FLOAT_EQ(world.bounds[5].restitution, 0.5F);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#include "sinew/math/random.h"
#include "sinew/world/measure.h"

#include "tests/sanitized.h"
#include "tests/stepped.h"
#include "tests/worlds.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class World> using RealOf = typename World::Real;

/// A figure of particles in a world that falls, swept.
template <class World> FigureIndex swept_figure(World& world, bool tethers = false) {
    const auto figure = add_figure(world, "cloth" + std::to_string(world.figures.size()));
    world.figures[figure].direct = Direct::off;
    world.figures[figure].tethers = tethers;
    return figure;
}

struct ClothSpec {
    int columns = 12, rows = 12;
    bool shuffled = false, level = false, tethers = false, bends = false, mixed = false, equal_mass = false,
         free = false;
    double spacing = 0.05;
};

/// All threads of one direction and then those of the next; or everything in any order.
template <class World> void add_cloth(World& world, const ClothSpec& cloth) {
    using Real = RealOf<World>;
    constexpr int D = World::dimension;
    const auto figure = swept_figure(world, cloth.tethers);
    const auto n = std::size_t(cloth.columns * cloth.rows);
    const auto shuffle = [&](auto& list) {
        for (std::size_t i = list.size() - 1; cloth.shuffled && i > 0; --i)
            std::swap(list[i], list[std::size_t(random::whole(0, std::int64_t(i), 7, i, 0))]);
    };
    std::vector<int> order(n);
    for (std::size_t i = 0; i < n; ++i) order[i] = int(i);
    shuffle(order);
    std::vector<ParticleId> id(n);
    for (const int i : order) {
        const double across = cloth.spacing * (i % cloth.columns), down = cloth.spacing * (i / cloth.columns);
        Vec<D, Real> position{};
        position[0] = Real(across);
        position[1] = Real(cloth.level ? 0 : -down);
        if constexpr (D == 3)
            position[2] = Real(cloth.level ? down : 1e-4 * random::symmetric<double>(3, std::uint64_t(i), 0));
        id[std::size_t(i)] = add_particle(
            world, {.position = position, .mass = Real(cloth.equal_mass ? 1 : 1 + i % 3), .figure = figure});
    }
    std::vector<std::pair<int, int>> threads;
    const auto weave = [&](int across, int down) {
        for (int r = 0; r + down < cloth.rows; ++r)
            for (int c = std::max(0, -across); c < cloth.columns - std::max(0, across); ++c)
                threads.emplace_back(r * cloth.columns + c, (r + down) * cloth.columns + c + across);
    };
    weave(1, 0), weave(0, 1), weave(1, 1), weave(-1, 1);
    if (cloth.bends) weave(2, 0), weave(0, 2);
    shuffle(threads);
    for (const auto& [a, b] : threads) {
        const int across = a % cloth.columns - b % cloth.columns, down = a / cloth.columns - b / cloth.columns;
        const auto length = Real(cloth.spacing * std::sqrt(double(across * across + down * down)));
        ConstraintSpec<Real> spec{.limits = exactly(length), .figure = figure};
        if (cloth.mixed && (a + b) % 3 == 0) spec.limits = at_most(length);
        if (cloth.mixed && (a + b) % 5 == 0) spec.compliance = Real(1e-4);
        add<Distance>(world, {id[std::size_t(a)], id[std::size_t(b)]}, spec);
    }
    if (cloth.free) return;
    pin(world, id[0]);
    pin(world, id[std::size_t(cloth.columns - 1)]);
}

/// Chains of the same shape, one beside the other.
template <class World> void add_chains(World& world, int chains) {
    using Real = RealOf<World>;
    for (int c = 0; c < chains; ++c) {
        const auto figure = swept_figure(world);
        std::vector<ParticleId> id;
        for (int i = 0; i < 8; ++i)
            id.push_back(add_particle(
                world, {.position = at<typename World::Vector>(0.1 * i + c, 0), .mass = Real(1), .figure = figure}));
        for (std::size_t i = 0; i + 1 < id.size(); ++i)
            add<Distance>(world, {id[i], id[i + 1]}, {.limits = exactly(Real(0.1)), .figure = figure});
        pin(world, id[0]);
    }
}

/// What the engine can choose between: directions, rows, colours, copies, and a list as it stands.
template <class World> World of_every_order(bool mixed = false) {
    World world;
    fall(world, gravity);
    world.settings.substeps = 10;
    add_cloth(world, {.columns = 37, .mixed = mixed});
    add_cloth(world, {.columns = 38, .mixed = mixed, .equal_mass = true});
    add_cloth(world, {.columns = 9, .rows = 20, .bends = true, .mixed = mixed});
    add_cloth(world, {.shuffled = true, .mixed = mixed});
    add_cloth(world, {.columns = 25, .rows = 15, .shuffled = true, .mixed = mixed});
    add_cloth(world, {.columns = 3, .rows = 3, .mixed = mixed});
    add_chains(world, 21);
    return world;
}

/// So that what holds them snaps taut.
template <class World> void hurl(World& world) {
    for (Row row = 0; row < world.particles.size(); ++row)
        world.particles.velocity[row][0] = RealOf<World>(20 * random::symmetric<double>(4, row, 0));
}

template <class Type> struct Planned : ::testing::Test {};
TYPED_TEST_SUITE(Planned, Everywhere, Names);

TYPED_TEST(Planned, EveryWidthOfLanesGivesTheSameBits) {
    for (const bool mixed : {false, true})
        for (const int iterations : {1, 2}) {
            auto begun = of_every_order<typename TypeParam::World>(mixed);
            begun.settings.iterations = iterations;
            add_cloth(begun, {.columns = 21, .rows = 15, .tethers = true, .mixed = mixed});
            hurl(begun);
            std::set<std::uint64_t> hashes;
            for (const Simd simd : {Simd::one, Simd::sse2, Simd::avx2, Simd::avx512}) {
                if (!has_simd(simd)) continue;
                auto world = begun;
                world.solver.options.simd = simd;
                bool repair_window = false;
                for (int i = 0; i < 5; ++i) {
                    step(world, RealOf<typename TypeParam::World>(1.0 / 60));
                    repair_window = repair_window || world.repair_window;
                }
                hashes.insert(state_hash(world));
                EXPECT_TRUE(repair_window || mixed); // where every run has something soft none is swept again
            }
            EXPECT_EQ(hashes.size(), 1U) << mixed << ' ' << iterations;
        }
}

// Packs of up to 16 are solved at once.
TYPED_TEST(Planned, LinksSolvedTogetherShareNoParticleAndNoneIsLeftOut) {
    auto world = of_every_order<typename TypeParam::World>(true);
    prepare(world);
    const auto& plan = world.solver.sweep_state.plan;
    const auto& table = std::get<0>(world.constraints);
    std::vector<int> seen(table.size(), 0);
    std::size_t long_ones = 0;
    for (const auto& run : plan.runs) {
        std::vector<std::uint32_t> ends;
        long_ones += run.count >= 16;
        for (std::uint32_t i = 0; i < run.count; ++i) {
            const Row row = plan.row_of(run, i);
            const Row a = run.scattered ? plan.ends_a[run.a + i] : run.a + i;
            const Row b = run.scattered ? plan.ends_b[run.a + i] : run.b + i;
            ++seen[row];
            const auto members = std::minmax({table.members.rows[row][0], table.members.rows[row][1]});
            EXPECT_EQ(std::minmax({world.solver.sweep_state.row_of[a], world.solver.sweep_state.row_of[b]}), members);
            const auto at = run.uniform ? run.parameters : run.parameters + i;
            const auto low = std::max(table.low(row), decltype(table.low(row))(0)); // nothing is shorter
            EXPECT_TRUE(plan.parameters.are(at, low, table.high(row), table.compliance[row]));
            ends.push_back(a), ends.push_back(b);
            const auto last = ends.end() - std::ptrdiff_t(std::min<std::size_t>(ends.size(), 32));
            EXPECT_EQ(std::set(last, ends.end()).size(), std::size_t(ends.end() - last));
        }
    }
    EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
    EXPECT_GT(long_ones, 40U);
}

// Of two particles the lighter one goes further, so that nothing pushes itself off.
TYPED_TEST(Planned, LinksOfAnyKindKeepTheMomentum) {
    using World = typename TypeParam::World;
    std::set<LinkKind> kinds;
    for (const bool equal_mass : {false, true})
        for (const bool mixed : {false, true}) {
            World world;
            world.settings.substeps = 10;
            world.settings.iterations = mixed ? 2 : 1;
            add_cloth(world, {.columns = 20, .mixed = mixed, .equal_mass = equal_mass, .free = true});
            hurl(world);
            const auto before = momentum(world);
            const auto speed = max_speed(world);
            for (int i = 0; i < 10; ++i) step(world, RealOf<World>(1.0 / 60));
            EXPECT_LT(max_speed(world), 0.8 * speed);
            const auto rounding = 1e4 * double(std::numeric_limits<RealOf<World>>::epsilon());
            EXPECT_LT(norm(momentum(world) - before), rounding * total_mass(world)) << equal_mass << mixed;
            for (const auto& run : world.solver.sweep_state.plan.runs) kinds.insert(run.kind);
        }
    EXPECT_TRUE(kinds.contains(LinkKind::equality) && kinds.contains(LinkKind::equality_uneven));
}

// Ends that may not be apart, and are not.
TYPED_TEST(Planned, LinksOfNoLengthFallAsOne) {
    using World = typename TypeParam::World;
    using Real = RealOf<World>;
    for (const bool equal_mass : {false, true}) {
        World world;
        fall(world, gravity);
        add_cloth(world, {.columns = 20, .equal_mass = equal_mass, .free = true});
        auto& links = std::get<kind_number<Distance, World::dimension>>(world.constraints);
        for (Row row = 0; row < links.size(); ++row) links.limits.set(row, -limit::measure<Real>, Real(0));
        for (auto& position : world.particles.position) position = {};
        for (int i = 0; i < 3; ++i) step(world, Real(1.0 / 60));
        for (const auto& position : world.particles.position) EXPECT_LT(norm(position), 0.1);
        EXPECT_TRUE(std::ranges::any_of(world.solver.sweep_state.plan.runs,
                                        [](const auto& run) { return run.kind >= LinkKind::inequality; }));
    }
}

// Squeezed to nothing, as heavy as can be and hardly to be moved through what holds it up.
TYPED_TEST(Planned, LinksOfAnyKindStayFinite) {
    using World = typename TypeParam::World;
    using Real = RealOf<World>;
    for (const auto& [equal_mass, heavily] : {std::pair(false, false), {false, true}, {true, false}, {true, true}}) {
        World world;
        fall(world, heavily ? 1e26 : gravity);
        world.settings.substeps = heavily ? 1000 : 10;
        world.settings.damping = heavily ? Real(0) : limit::measure<Real>;
        add_cloth(world, {.columns = 20, .equal_mass = equal_mass});
        add_chains(world, 21);
        for (Row row = 0; row < world.particles.size(); ++row) {
            const auto id = world.particles.handles.id_of(row);
            set_mass(world, id, limit::mass<Real> / Real(equal_mass ? 1 : 1 + row % 3));
            set_position(world, id, world.particles.position[row] * Real(1e-13));
        }
        for (int i = 0; i < 3; ++i) {
            step(world, Real(1.0 / 60));
            EXPECT_TRUE(world.events.empty());
        }
        for (const auto& position : world.particles.position) EXPECT_TRUE(is_finite(position));
    }
}

TEST(Planned, AnyNumberOfThreadsGivesTheSameBits) {
    for (const auto& [shuffled, iterations] : {std::pair(false, 1), {true, 1}, {false, 3}}) {
        test::Stepped<3, float> begun;
        fall(begun, gravity);
        begun.settings.substeps = 8 / iterations;
        begun.settings.iterations = iterations;
        add_cloth(begun, {.columns = 96, .rows = 96, .shuffled = shuffled, .tethers = true});
        add_cloth(begun, {});
        hurl(begun);
        std::set<std::uint64_t> hashes;
        for (int threads = 1; threads <= 4; threads += sanitized ? 2 : 1) {
            auto world = begun;
            world.solver.options.threads = threads;
            for (int i = 0; i < 3; ++i) step(world, 1.0F / 60);
            hashes.insert(state_hash(world));
            EXPECT_TRUE(world.repair_window);
        }
        EXPECT_EQ(hashes.size(), 1U);
    }
}

// Cell by cell, a cloth in substeps grows without bound. None of the orders that are chosen may: the energy never
// passes that of the start by more than what one sweep leaves of the constraints.
TEST(Planned, NoOrderGainsEnergyInTenThousandSubsteps) {
    using Make = std::function<void(test::Stepped<3, float>&)>;
    const std::vector<std::pair<const char*, Make>> orders = {
        {"directions", [](auto& world) { add_cloth(world, {.columns = 9, .rows = 9, .level = true}); }},
        {"with bends", [](auto& world) { add_cloth(world, {.columns = 9, .rows = 9, .level = true, .bends = true}); }},
        {"tethers", [](auto& world) { add_cloth(world, {.columns = 9, .rows = 9, .level = true, .tethers = true}); }},
        {"swept again",
         [](auto& world) { add_cloth(world, {.columns = 24, .rows = 24, .level = true, .tethers = true}); }},
        {"colours", [](auto& world) { add_cloth(world, {.columns = 9, .rows = 9, .shuffled = true, .level = true}); }},
        {"rows", [](auto& world) { add_cloth(world, {.columns = 16, .rows = 16, .shuffled = true, .level = true}); }},
        {"list", [](auto& world) { add_cloth(world, {.columns = 3, .rows = 3, .level = true}); }},
        {"copies", [](auto& world) { add_chains(world, 9); }}};
    for (const auto& [name, add] : orders) {
        test::Stepped<3, float> world;
        fall(world, gravity);
        world.settings.substeps = 10;
        add(world);
        const double begun = energy(world).total(), deepest = gravity * total_mass(world) * 0.6;
        double max = begun;
        int repair_window = 0;
        const int steps = sanitized ? 100 : 1000;
        for (int i = 0; i < steps; ++i) {
            step(world, 1.0F / 60);
            max = std::max(max, energy(world).total());
            repair_window += world.repair_window > 0;
        }
        EXPECT_GE(repair_window, name == std::string("swept again") ? steps / 10 : 0) << name;
        EXPECT_LT(max - begun, 0.01 * deepest) << name;
        EXPECT_LT(max_speed(world), 10) << name;
    }
}

TEST(Tethers, FollowThePinsAndAreNotWhereThingsTearOrGive) {
    test::Stepped<3, float> world;
    add_cloth(world, {.tethers = true});
    prepare(world);
    EXPECT_EQ(world.solver.sweep_state.plan.tethers.size(), 2U);
    unpin(world, world.pin_handles.id_of(0));
    prepare(world);
    EXPECT_EQ(world.solver.sweep_state.plan.tethers.size(), 1U);
    unpin(world, world.pin_handles.id_of(0));
    prepare(world);
    EXPECT_TRUE(world.solver.sweep_state.plan.tethers.empty());

    test::Stepped<3, float> tearing;
    add_cloth(tearing, {.tethers = true});
    add_cloth(tearing, {});
    std::get<0>(tearing.constraints).breaking_strain.set(0, 0.5F);
    prepare(tearing);
    EXPECT_TRUE(tearing.solver.sweep_state.plan.tethers.empty());
}

// No way from a pin along the threads is shorter than the straight one: of a cloth at rest no tether is taut.
TEST(Tethers, ReachAsFarAsTheThreads) {
    test::Stepped<3, double> world;
    add_cloth(world, {.tethers = true});
    prepare(world);
    const auto& sweep_state = world.solver.sweep_state;
    for (const auto& tether : sweep_state.plan.tethers) {
        const Row pinned = *world.particles.handles.find(world.pins[tether.pin].particle);
        for (Row slot = 0; slot < sweep_state.size(); ++slot) {
            const double far =
                distance(world.particles.position[sweep_state.row_of[slot]], world.particles.position[pinned]);
            const double per_square = 2 * sweep_state.plan.half_per_max_length_square[tether.first + slot];
            const double reach = per_square > 0 ? 1 / std::sqrt(per_square) : 0;
            EXPECT_LE(far, reach + 1e-6);
            EXPECT_GE(far * 1.1 + 1e-3, reach); // eight directions come within 8 %
        }
    }
}

TEST(GettingReady, TellsHowFarItIs) {
    test::Stepped<3, double> world;
    add_cloth(world, {.tethers = true});
    std::vector<double> shares;
    world.solver.reports.preparing = [&](double share) { shares.push_back(share); };
    prepare(world);
    ASSERT_GE(shares.size(), 6U);
    EXPECT_EQ(shares.front(), 0);
    EXPECT_EQ(shares.back(), 1);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    const auto last_substep = shares.size();
    prepare(world); // nothing to do
    EXPECT_EQ(shares.size(), last_substep);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#include "sinew/prefab/prefabs.h"
#include "sinew/world/colliders.h"

#include "tests/crates.h"
#include "tests/dice.h"
#include "tests/prefab/make.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <numbers>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct EnergyBound : ::testing::Test {};
TYPED_TEST_SUITE(EnergyBound, Everywhere, Names);

/// A wheel of springs that only the sweep solves, turning.
template <class World> IdList<ConstraintId> wheel(World& world) {
    using Real = typename World::Real;
    using Vector = typename World::Vector;
    const auto figure = add_figure(world, "wheel");
    world.figures[figure].direct = Direct::off;
    const auto particle = [&](const Vector& position, const Vector& velocity, Real mass) {
        return add_particle(world, {.position = position, .velocity = velocity, .mass = mass, .figure = figure});
    };
    IdList<ConstraintId> spokes;
    const auto hub = particle({}, {}, Real(0.1));
    for (int i = 0; i < 4; ++i) {
        const double x = i % 2 == 0 ? 1 - i : 0, y = i % 2 == 1 ? 2 - i : 0;
        const auto end = particle(at<Vector>(x, y), at<Vector>(-3 * y, 3 * x), Real(2));
        spokes.push_back(*add<Distance>(world, {hub, end}, {.compliance = Real(1e-6), .figure = figure}));
    }
    return spokes;
}

TYPED_TEST(EnergyBound, LeavesWhatAnEditPutsIn) {
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    const auto spokes = wheel(world);
    run(world, 0.5);
    const double before = energy(world).kinetic;
    for (const auto& spoke : spokes) set_limits(world, spoke, exactly(Real(0.9)));
    auto copy = world;
    for (int i = 0; i < 30; ++i) {
        step(world, Real(1.0 / 60));
        step(copy, Real(1.0 / 60));
        ASSERT_EQ(state_hash(world), state_hash(copy)) << "step " << i;
    }
    // the spin stays, of 2 * 4 * 3 on an arm of 0.9 for 1: the kinetic energy of the rotation grows by 1 / 0.81
    EXPECT_GT(energy(world).kinetic, 1.15 * before);
}

TYPED_TEST(EnergyBound, LeavesFlightOverAFloorAlone) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World free, walled;
    for (auto* world : {&free, &walled}) {
        fall(*world, 9.81);
        add_particle(*world, {.position = at<Vector>(0, 1), .velocity = at<Vector>(2, 10), .radius = Real(0.1)});
    }
    walled.bounds.push_back({Vector::axis(1), 0, 0, 0});
    for (int i = 0; i < 60; ++i) {
        const Real dt = Real(i % 3 == 0 ? 1.0 / 30 : 1.0 / 120);
        step(free, dt);
        step(walled, dt);
        ASSERT_EQ(free.particles.velocity[0], walled.particles.velocity[0]) << "step " << i;
    }
}

TYPED_TEST(EnergyBound, PartsCoincidentBallsGently) {
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    for (int i = 0; i < 8; ++i) {
        const auto figure = add_figure(world, "ball" + std::to_string(i));
        add_particle(world, {.radius = Real(0.1), .figure = figure});
        set_contact(world, figure, {.figures = true});
    }
    double fastest = 0;
    for (int i = 0; i < 120; ++i) {
        step(world, Real(1.0 / 60));
        fastest = std::max(fastest, max_speed(world));
    }
    EXPECT_LT(fastest, 0.1);
    for (Row a = 0; a < 8; ++a)
        for (Row b = 0; b < a; ++b)
            EXPECT_GT(double(distance(world.particles.position[a], world.particles.position[b])), 0.19);
}

/// Figures that begin inside each other part, with friction: a wheel does not spin up.
TEST(EnergyBounds, AWheelInAFigureStaysSlow) {
    Dice dice(1);
    for (const int substeps : {8, 16, 64})
        for (int i = 0; i < 4; ++i) {
            FlatWorld<double> world;
            world.settings.substeps = substeps;
            const auto put = [&](const auto& prefab, const char* name, double x, double y) {
                build(world, prefab, name, Placement<2, double>{.at = {{x, y}}, .turn = dice.between(0, 6)});
                set_contact(world, FigureIndex(world.figures.size() - 1), {.figures = true, .friction = 0.6});
            };
            put(Wheel{}, "wheel", dice.between(-0.3, 0.3), dice.between(-0.3, 0.3));
            put(StickFigure{}, "man", 0, 0);
            double most = 0;
            for (int step_number = 0; step_number < 60; ++step_number) {
                step(world, 1.0 / 60);
                most = std::max(most, energy(world).kinetic);
            }
            EXPECT_LT(most, 0.1 * total_mass(world)) << substeps << ' ' << i;
        }
}

/// Rigid diagonals between springs are chains of links, those of the corners single ones: a long step turns them by
/// more than a quarter.
template <class Real> void throw_cloth(int size, int iterations) {
    Stepped<3, Real> world;
    world.settings.substeps = 1, world.settings.iterations = iterations;
    fall(world, gravity);
    const Cloth cloth{
        .columns = size, .rows = size, .spacing = 0.035, .diagonals = "one", .elasticity = {.compliance = 2.5e-5}};
    const auto figure = build(world, cloth, "cloth", Placement<3, Real>{.turn = std::numbers::pi / 2});
    set_contact(world, figure, {.figures = true});
    for (Row row = 0; row < world.particles.size(); ++row)
        if (world.particles.inverse_mass[row] > 0)
            world.particles.velocity[row] = {{Real(-0.93), Real(-0.7), Real(0.16)}};
    const auto begun = energy(world);
    const double tolerance = 1e-3 * std::max(begun.kinetic, total_mass(world) * gravity * 0.035 * size);
    for (int i = 0; i < 120; ++i) {
        step(world, Real(1.0 / 60));
        ASSERT_LE(energy(world).total(), begun.total() + tolerance) << size << " x " << iterations << ", step " << i;
    }
}
TEST(EnergyBounds, ClothWithRigidDiagonalsGainsNothing) {
    for (int size = 6; size <= 16; ++size)
        for (const int iterations : {1, 3}) {
            throw_cloth<double>(size, iterations);
            throw_cloth<float>(size, iterations);
        }
}

/// Ribbons of cloth that hang taut by all or two of their corners, with `buckling`: nets of ranges with more
/// constraints than unknowns, which a block often cannot satisfy. The motion found instead must not tighten springs
/// from nothing. The way back to the lengths lifts a ribbon by up to 1.3 % of weight times length.
template <class Real> void hang_ribbon(int columns, const char* pins, double buckling, int substeps) {
    Stepped<2, Real> world;
    world.settings.substeps = substeps;
    fall(world, gravity);
    const Cloth cloth{
        .columns = columns, .rows = 2, .spacing = 0.061164, .pins = pins, .buckling = buckling, .mass = 0.186117};
    build(world, cloth, "ribbon", Placement<2, Real>{.at = {{Real(0), Real(4)}}});
    const auto moving = [&] { return energy(world).kinetic + energy(world).potential; };
    const double begun = moving(), tolerance = 2e-2 * total_mass(world) * gravity * cloth.spacing * columns;
    for (int i = 0; i < 240; ++i) {
        step(world, Real(1.0 / 60));
        ASSERT_LE(moving(), begun + tolerance)
            << columns << ' ' << pins << ' ' << buckling << ' ' << substeps << ", step " << i;
    }
}
TEST(EnergyBounds, TautRibbonsWithBucklingGainNothing) {
    for (const int columns : {8, 10})
        for (const char* pins : {"corners", "all_corners"})
            for (const double buckling : {0.1, 0.4})
                for (const int substeps : {1, 4, 16}) {
                    hang_ribbon<double>(columns, pins, buckling, substeps);
                    hang_ribbon<float>(columns, pins, buckling, substeps);
                }
}

/// Folded chains of light links in free flight, with bend limits and a heavy end: a blow at a limit whose equations
/// have no exact solution is none.
TEST(EnergyBounds, FoldedChainsWithHeavyEndsGainNothing) {
    Dice dice(3);
    for (int i = 0; i < few_or_many(60, 1000); ++i) {
        Stepped<2, double> world;
        world.settings.substeps = 1 << dice.below(4);
        fall(world, gravity);
        const Chain chain{.loop = dice.scale(0.05, 1),
                          .slack = dice.between(1, 30),
                          .pinned = "none",
                          .mass = dice.scale(0.01, 0.1),
                          .weight = dice.scale(10, 120),
                          .bend_limit = dice.between(0.4, 1.6)};
        build(world, chain, "chain", Placement<2, double>{.turn = dice.between(0, 6)});
        const double weight = (chain.mass + chain.weight) * gravity, begun = energy(world).total();
        for (int step_number = 0; step_number < 60; ++step_number) {
            step(world, 1.0 / 60);
            ASSERT_LE(energy(world).total(), begun + 1e-3 * weight * chain.loop * chain.links) << i;
        }
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#include "tests/stepped.h"
#include "tests/worlds.h"

#include <cmath>

/// Motions whose answer is known, exactly or as the discrete scheme has it.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Motion : ::testing::Test {};
TYPED_TEST_SUITE(Motion, Everywhere, Names);

// After n substeps of h from rest at speed v: x = v t - g t^2 / 2 exactly, for the first kick spans half a substep.
// Float sums 960 additions a second, each carried on by its residual: what is left is the rounding of the velocity.
TYPED_TEST(Motion, FreeFlightIsTheDiscreteParabola) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    fall(world, 10);
    const auto ball = add_particle(world, {.velocity = at<Vector>(3, 8)});
    for (int i = 1; i <= 120; ++i) {
        step(world, Real(1.0 / 64));
        const double t = i / 64.0; // a power of two: exact
        const double scale = TypeParam::precise ? 1e-13 : 2e-5;
        EXPECT_NEAR((*position_of(world, ball))[0], 3 * t, scale * 10);
        EXPECT_NEAR((*position_of(world, ball))[1], 8 * t - 5 * t * t, scale * 10);
    }
}

TYPED_TEST(Motion, ALaunchAtFortyFiveDegreesLandsAtVSquaredOverG) {
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    fall(world, 10);
    const auto ball = add_particle(world, {.velocity = at<Vector>(8, 8)});
    run(world, 1.6, 40); // 2 v_y / g
    EXPECT_NEAR((*position_of(world, ball))[0], 128 / 10.0, 1e-4);
    EXPECT_NEAR((*position_of(world, ball))[1], 0, 1e-4);
}

// Time-corrected Verlet: the parabola whatever the sequence of step lengths.
TYPED_TEST(Motion, ChangingTheStepKeepsTheParabola) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    for (const Mode mode : {Mode::physical, Mode::classic}) {
        typename TypeParam::World world;
        world.settings.mode = mode;
        world.settings.substeps = 4;
        fall(world, 10);
        const auto ball = add_particle(world, {.velocity = at<Vector>(3, 8)});
        double t = 0, wrong = 0;
        for (int i = 0; i < 60; ++i) {
            const double dt = i % 7 == 0 ? 1.0 / 32 : i % 3 == 0 ? 1.0 / 128 : 1.0 / 64;
            step(world, Real(dt));
            t += dt;
            wrong = std::max(wrong, std::abs(double((*position_of(world, ball))[1]) - (8 * t - 5 * t * t)));
        }
        if (mode == Mode::physical)
            EXPECT_LT(wrong, TypeParam::precise ? 1e-13 : 1e-4);
        else // the originals' step: whole kicks and no look at the last one; off by a first-order term, a dt t
            EXPECT_LT(wrong, 10 * t / 32);
    }
}

/// The quarter period's elliptic integral by the arithmetic-geometric mean: T = 2 pi sqrt(L/g) / agm(1, cos(a/2)).
double pendulum_period(double length, double g, double amplitude) {
    double a = 1, b = std::cos(amplitude / 2);
    for (int i = 0; i < 30; ++i) {
        const double mean = (a + b) / 2;
        b = std::sqrt(a * b);
        a = mean;
    }
    return 2 * pi<double> * std::sqrt(length / g) / a;
}

/// Mean period over ten swings, from where the bob passes below the pivot (interpolated).
template <class World> double measured_period(int substeps, double rate, double amplitude) {
    using Vector = typename World::Vector;
    using Real = typename World::Real;
    World world;
    world.settings.substeps = substeps;
    fall(world, 10);
    const auto pivot = add_particle(world, {.mass = std::numeric_limits<Real>::infinity()});
    const auto bob = add_particle(world, {.position = at<Vector>(std::sin(amplitude), -std::cos(amplitude))});
    add<Distance>(world, {pivot, bob}, {.limits = exactly(Real(1))});
    std::vector<double> passes;
    double before = double((*position_of(world, bob))[0]);
    for (int i = 0; passes.size() < 21; ++i) {
        step(world, Real(1 / rate));
        const double now = double((*position_of(world, bob))[0]);
        if ((before > 0) != (now > 0)) {
            // cubic Hermite from both places and speeds would be finer; at its fastest the path is straight to dt^3
            passes.push_back((i + before / (before - now)) / rate);
        }
        before = now;
    }
    return (passes[20] - passes[0]) / 10;
}

// The error falls with the square of the substep: by 4 for each halving.
TEST(Pendulum, PeriodConvergesToTheEllipticIntegralWithSecondOrder) {
    const double exact = pendulum_period(1, 10, 0.9);
    std::vector<double> errors;
    for (const int substeps : {1, 2, 4, 8})
        errors.push_back(std::abs(measured_period<test::Stepped<2, double>>(substeps, 60, 0.9) / exact - 1));
    for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
        const double order = std::log2(errors[i] / errors[i + 1]);
        EXPECT_NEAR(order, 2, 0.25) << errors[i] << ' ' << errors[i + 1];
    }
    EXPECT_LT(errors[3], 1e-4);
}

TYPED_TEST(Motion, PendulumPeriodIsRightWithSixtyFourSubstepsAt240Hz) {
    const double exact = pendulum_period(1, 10, 0.9);
    const double error = measured_period<typename TypeParam::World>(64, 240, 0.9) / exact - 1;
    // measured 3e-9 and 8e-6: float loses what rounding takes from 15360 corrections a second
    EXPECT_NEAR(error, 0, TypeParam::precise ? 1e-7 : 5e-5);
}

TYPED_TEST(Motion, AFrictionlessSwingKeepsItsEnergyForAMinute) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    fall(world, 10);
    const auto pivot = add_particle(world, {.mass = std::numeric_limits<Real>::infinity()});
    const auto bob = add_particle(world, {.position = at<Vector>(std::sin(0.9), -std::cos(0.9))});
    add<Distance>(world, {pivot, bob});
    const double lowest = -10, start = -10 * std::cos(0.9);
    double max = -1e9, min = 1e9;
    for (int i = 0; i < 3600; ++i) {
        step(world, Real(1.0 / 60));
        if (i < 2) continue; // the first substep's velocity is a half one
        max = std::max(max, energy(world).total());
        min = std::min(min, energy(world).total());
    }
    // of the swing's own energy, m g L (1 - cos 0.9) = 3.78 J
    EXPECT_NEAR(max, start, 1e-4 * (start - lowest));
    EXPECT_NEAR(min, start, 1e-4 * (start - lowest));
}

// m g / k, whatever the number of substeps and iterations, with the damping that brings it to rest.
TYPED_TEST(Motion, AHangingWeightStretchesItsSpringByMgOverK) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    for (const int substeps : {1, 2, 7, 16, 64})
        for (const int iterations : {1, 2, 7, 16, 64}) {
            typename TypeParam::World world;
            world.settings.substeps = substeps;
            world.settings.iterations = iterations;
            world.settings.damping = 5;
            fall(world, 10);
            const auto hook = add_particle(world, {.mass = std::numeric_limits<Real>::infinity()});
            const auto weight = add_particle(world, {.position = at<Vector>(0, -1), .mass = 2});
            const auto spring = *add<Distance>(world, {hook, weight}, {.compliance = Real(0.005)});
            run(world, 8);
            // float: one unit of the last place of a coordinate near 1 is 1e-7
            EXPECT_NEAR(-(*position_of(world, weight))[1], 1 + 2 * 10 * 0.005, TypeParam::precise ? 1e-9 : 2e-6)
                << substeps << ' ' << iterations;
            EXPECT_NEAR(constraint_state(world, spring)->tension, 20, TypeParam::precise ? 1e-6 : 1e-2)
                << substeps << ' ' << iterations;
        }
}

// x = cos(w t) without damping: the frequency sqrt(k / m), to the scheme's (w h)^2 / 24.
TEST(Spring, SwingsWithItsOwnFrequency) {
    test::Stepped<2, double> world;
    const auto wall = add_particle(world, {.mass = std::numeric_limits<double>::infinity()});
    const auto bob = add_particle(world, {.position = {2, 0}});
    add<Distance>(world, {wall, bob}, {.limits = exactly(1.0), .compliance = 0.01}); // w = 10
    int crossings = 0;
    double before = 1, last = 0, first = 0;
    for (int i = 1; crossings < 21; ++i) {
        step(world, 1.0 / 240);
        const double now = (*position_of(world, bob))[0] - 1;
        if ((before > 0) != (now > 0)) {
            last = (i - 1 + before / (before - now)) / 240;
            if (crossings++ == 0) first = last;
        }
        before = now;
    }
    EXPECT_NEAR((last - first) / 10 / (2 * pi<double> / 10), 1, 1e-4);
}

// A free ragdoll-like heap of links: nothing from outside, so neither momentum changes but by rounding.
TYPED_TEST(Motion, AFreeFigureKeepsItsMomentumAndItsCentreMovesStraight) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    const auto ids = chain(world, 6, at<Vector>(0, 0), at<Vector>(0.5, 0.25));
    add<Distance>(world, {ids[0], ids[3]}, {.limits = at_most(Real(1.2)), .compliance = Real(1e-4)});
    add<Angle>(world, {ids[1], ids[2], ids[3]}, {.limits = between(Real(0.2), Real(1))});
    for (std::size_t i = 0; i < 6; ++i) {
        set_mass(world, ids[i], Real(1 + double(i % 3)));
        set_velocity(world, ids[i], at<Vector>(double(i % 2), double(i % 4) - 1));
    }
    step(world, Real(1.0 / 60));
    const auto momentum_before = momentum(world), center_before = center_of_mass(world);
    const auto spin_before = angular_momentum(world);
    run(world, 10);
    const double rounding = TypeParam::precise ? 2e-11 : 2e-2; // 10000 substeps of tens of roundings each
    EXPECT_LT(norm(momentum(world) - momentum_before), rounding);
    EXPECT_LT(distance(center_of_mass(world), center_before + momentum_before * (10 / total_mass(world))), rounding);
    EXPECT_LT(norm(angular_momentum(world) - spin_before), (TypeParam::precise ? 2e-2 : 1e-1) * norm(spin_before));
}

TYPED_TEST(Motion, ASpinningRodKeepsItsAngularMomentumAndEnergy) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    const auto ids = chain(world, 2, at<Vector>(-1, 0), at<Vector>(2, 0));
    set_velocity(world, ids[0], at<Vector>(0, -3));
    set_velocity(world, ids[1], at<Vector>(0, 3));
    step(world, Real(1.0 / 60));
    const auto spin = angular_momentum(world)[2], kinetic = energy(world).kinetic;
    run(world, 30);
    EXPECT_NEAR(angular_momentum(world)[2], spin, TypeParam::precise ? 1e-10 : 1e-2);
    EXPECT_NEAR(energy(world).kinetic / kinetic, 1, TypeParam::precise ? 1e-9 : 1e-3);
}

// v(t) = v e^(-damping t). The velocity is that of the middle of the last substep, early by h / 2: half a percent where
// damping is 5 / s and h = 1/480 s.
TYPED_TEST(Motion, DampingFollowsItsExponentialWithinOnePercent) {
    using Vector = typename TypeParam::Vector;
    for (const double rate : {30.0, 60.0, 144.0})
        for (const double damping : {0.1, 1.0, 5.0}) {
            typename TypeParam::World world;
            world.settings.damping = typename TypeParam::Real(damping);
            const auto puck = add_particle(world, {.velocity = at<Vector>(1, 0)});
            run(world, 0.5, rate);
            const double expected = std::exp(-damping * 0.5);
            EXPECT_NEAR((*velocity_of(world, puck))[0] / expected, 1, 0.01) << rate << ' ' << damping;
            EXPECT_NEAR((*position_of(world, puck))[0], (1 - expected) / damping, 0.01 * (1 - expected) / damping);
        }
}

// Falling through air: v = m g / c (1 - e^(-c t / m)).
TYPED_TEST(Motion, DragLeadsToTheTerminalVelocity) {
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    fall(world, 10);
    world.forces.push_back(Drag<TypeParam::dimension, Real>{4});
    const auto stone = add_particle(world, {.mass = 2});
    run(world, 0.5);
    EXPECT_NEAR((*velocity_of(world, stone))[1], -5 * (1 - std::exp(-1.0)), 0.005);
    run(world, 10);
    // float: a rounding of 1e-7 in each of 500 substeps that remember
    EXPECT_NEAR((*velocity_of(world, stone))[1], -5, TypeParam::precise ? 1e-4 : 5e-4);
}

TYPED_TEST(Motion, WindCarriesAtItsOwnSpeedAndGustsStayInRange) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    world.forces.push_back(Wind<TypeParam::dimension, Real>{.velocity = at<Vector>(3, 0), .strength = 50});
    const auto leaf = add_particle(world, {});
    run(world, 2);
    EXPECT_NEAR((*velocity_of(world, leaf))[0], 3, 1e-3);
    world.forces = {Wind<TypeParam::dimension, Real>{.velocity = at<Vector>(3, 0),
                                                     .strength = 50,
                                                     .gust = at<Vector>(2, 1),
                                                     .gust_period = Real(0.5),
                                                     .gust_size = 4}};
    double min = 9, max = 0;
    for (int i = 0; i < 1200; ++i) {
        step(world, Real(1.0 / 60));
        min = std::min(min, double((*velocity_of(world, leaf))[0]));
        max = std::max(max, double((*velocity_of(world, leaf))[0]));
    }
    EXPECT_TRUE(min >= 1 && min < 2.2 && max <= 5 && max > 3.8) << min << ' ' << max;
}

// A circle about a soft centre: v^2 = s r^2 / (r^2 + soft^2)^(3/2).
TYPED_TEST(Motion, AnAttractorHoldsACircularOrbit) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    world.forces.push_back(Attractor<TypeParam::dimension, Real>{.strength = 20, .softness = Real(0.5)});
    const double speed = std::sqrt(20 * 4 / std::pow(4.25, 1.5));
    const auto moon = add_particle(world, {.position = at<Vector>(2, 0), .velocity = at<Vector>(0, speed)});
    for (int i = 0; i < 600; ++i) {
        step(world, Real(1.0 / 60));
        ASSERT_NEAR(norm(*position_of(world, moon)), 2, 1e-3);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

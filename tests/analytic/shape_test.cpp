#include "tests/worlds.h"

#include <cmath>

/// Shapes at rest, what does not depend on where or how fast one looks, and what is kept.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Shapes : ::testing::Test {};
TYPED_TEST_SUITE(Shapes, Everywhere, Names);

// A rope of 40 links, 2 long, between two nails 1.2 apart and of one height hangs in the catenary
// y = a cosh(x / a), where 2 a sinh(0.6 / a) = 2. Multipliers start from nothing in each substep, so each link is left
// long by about tension h^2 (2 / m): measured 0.4 % and an error of shape of 0.17 % of the length with 16 substeps, a
// sixteenth of it with these 64.
TYPED_TEST(Shapes, ARopeAtRestIsACatenary) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    fall(world, 10);
    world.settings.damping = 2;
    world.settings.substeps = 64;
    constexpr int links = 40;
    std::vector<ParticleId> p;
    for (int i = 0; i <= links; ++i) { // starts as a V
        const double s = double(i) / links, along = 2 * s - 1;
        p.push_back(add_particle(world, {.position = at<Vector>(0.6 * along, 0.8 * (std::abs(along) - 1))}));
    }
    for (std::size_t i = 0; i < links; ++i)
        add<Distance>(world, {p[i], p[i + 1]}, {.limits = exactly(Real(2.0 / links))});
    pin(world, p[0]);
    pin(world, p[links]);
    run(world, 12);
    double a = 0.3;
    for (int i = 0; i < 100; ++i)
        a -= (a * std::sinh(0.6 / a) - 1) / (std::sinh(0.6 / a) - 0.6 / a * std::cosh(0.6 / a));
    double wrong = 0;
    for (const auto& x : world.particles.position) {
        const double y = a * (std::cosh(double(x[0]) / a) - std::cosh(0.6 / a));
        wrong = std::max(wrong, std::abs(double(x[1]) - y));
    }
    EXPECT_LT(wrong, 1e-3);
    EXPECT_LT(stretch(world).max, 1e-3);
}

TYPED_TEST(Shapes, AreaAndVolumeAreKept) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    fall(world, 10);
    world.bounds.push_back({at<Vector>(0, 1), -1, Real(0.3), Real(0.3)});
    ConstraintId content;
    std::vector<ParticleId> p;
    if constexpr (TypeParam::dimension == 2) {
        for (int i = 0; i < 12; ++i)
            p.push_back(add_particle(
                world, {.position = at<Vector>(std::cos(pi<double> * i / 6), std::sin(pi<double> * i / 6) + 1)}));
        for (std::size_t i = 0; i < 12; ++i) add<Distance>(world, {p[i], p[(i + 1) % 12]});
        content = *add_constraint(world, kind_number<Area, 2>, std::span<const ParticleId>(p), ConstraintSpec<Real>{});
    } else {
        for (const Vector& x : {Vector{0, 1, 0}, Vector{1, 1, 0}, Vector{0, 2, 0}, Vector{0, 1, 1}})
            p.push_back(add_particle(world, {.position = x}));
        content = *add<Volume>(world, {p[0], p[1], p[2], p[3]});
    }
    const double before = constraint_state(world, content)->measure;
    double worst = 0;
    for (int i = 0; i < 300; ++i) {
        step(world, Real(1.0 / 60));
        worst = std::max(worst, std::abs(constraint_state(world, content)->measure / before - 1));
    }
    EXPECT_LT(worst, 0.01) << "while it strikes the floor, one iteration a substep";
    EXPECT_NEAR(constraint_state(world, content)->measure / before, 1, 1e-3);
}

/// A rope with a heavy end and a bend limit that swings into a wall-less night.
template <class World> World swinging(typename World::Vector offset, double angle) {
    using Vector = typename World::Vector;
    using Real = typename World::Real;
    const auto turned = [&](double x, double y) {
        return at<Vector>(x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle));
    };
    World world;
    world.forces.push_back(Gravity<World::dimension, Real>{turned(0, -10)});
    std::vector<ParticleId> p;
    for (int i = 0; i < 6; ++i)
        p.push_back(add_particle(world, {.position = turned(0.3 * i, -0.1 * i * i / 5.0) + offset}));
    for (std::size_t i = 0; i < 5; ++i) add<Distance>(world, {p[i], p[i + 1]});
    add<Angle>(world, {p[2], p[3], p[4]},
               {.limits = between(Real(World::dimension == 2 ? -0.3 : 0), Real(0.3)), .compliance = Real(1e-2)});
    pin(world, p[0]);
    set_mass(world, p[5], Real(3));
    return world;
}

// Rounded differently there, the two part as every chaotic motion parts rounding errors: for two seconds not by much.
TYPED_TEST(Shapes, TurningAndMovingTheWorldChangesNothingButThat) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    const double angle = 1.1;
    const auto offset = at<Vector>(4, -2);
    auto here = swinging<World>({}, 0), there = swinging<World>(offset, angle);
    run(here, 2);
    run(there, 2);
    for (Row row = 0; row < here.particles.size(); ++row) {
        const auto& x = here.particles.position[row];
        auto expected = x;
        expected[0] = typename TypeParam::Real(double(x[0]) * std::cos(angle) - double(x[1]) * std::sin(angle));
        expected[1] = typename TypeParam::Real(double(x[0]) * std::sin(angle) + double(x[1]) * std::cos(angle));
        EXPECT_LT(double(distance(expected + offset, there.particles.position[row])), TypeParam::precise ? 1e-9 : 2e-2);
    }
}

/// The largest difference of places after five seconds at 30 and 144 Hz from those at 60 Hz.
template <class Build> double spread(Build&& build) {
    auto reference = build();
    run(reference, 5, 60);
    double max = 0;
    for (const double rate : {30.0, 144.0}) {
        auto world = build();
        run(world, 5, rate);
        for (Row row = 0; row < world.particles.size(); ++row)
            max = std::max(max, double(distance(world.particles.position[row], reference.particles.position[row])));
    }
    return max;
}

// The scheme is of second order: the phase of a swing of w = 3.16 / s after 5 s differs by about w t (w h)^2 / 24,
// h = 1/480 s: 3e-5.
TYPED_TEST(Shapes, FrameRateDoesNotMatter) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    const double pendulum = spread([] {
        World world;
        fall(world, 10);
        const auto ids = chain(world, 2, at<Vector>(0, 0), at<Vector>(0.8, -0.6));
        pin(world, ids[0]);
        return world;
    });
    EXPECT_LT(pendulum, TypeParam::precise ? 1e-3 : 2e-3);

    const double projectile = spread([] {
        World world;
        fall(world, 10);
        world.forces.push_back(Drag<World::dimension, Real>{Real(0.5)});
        add_particle(world, {.velocity = at<Vector>(10, 30)});
        return world;
    });
    EXPECT_LT(projectile, 1e-2); // of 40 m

    const double spring = spread([] {
        World world;
        fall(world, 10);
        const auto ids = chain(world, 1, at<Vector>(0, 0), at<Vector>(0, -1));
        const auto weight = add_particle(world, {.position = at<Vector>(0, -1)});
        add<Distance>(world, {ids[0], weight}, {.compliance = Real(0.02)});
        pin(world, ids[0]);
        return world;
    });
    // of an amplitude of 0.2 m: what is soft is solved implicitly, which damps a swing of w = 7 / s by w^2 h / 2 = 0.03
    // / s
    EXPECT_LT(spring, 0.02);

    const double rope = spread([] { // swings chaotically at first, so it is damped as air would
        World world;
        fall(world, 10);
        world.settings.damping = Real(0.5);
        const auto ids = chain(world, 9, at<Vector>(0, 0), at<Vector>(0.125, 0));
        pin(world, ids[0]);
        return world;
    });
    EXPECT_LT(rope, 0.03); // of a rope of 1 m
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

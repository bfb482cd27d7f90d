#include "sinew/world/colliders.h"

#include "tests/worlds.h"

#include <cfenv>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

/// Particles that roll.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Rolling : ::testing::Test {};
TYPED_TEST_SUITE(Rolling, Everywhere, Names);

constexpr double g = 9.81, radius = 0.2;

/// Floor that keeps a ball from falling.
enum class Ground { plane, collider, rows };
constexpr auto grounds = {Ground::plane, Ground::collider, Ground::rows};

/// Ground through the origin that falls to the right by an angle.
template <class World> void add_slope(World& world, Ground ground, double angle, double friction) {
    using Real = typename World::Real;
    const auto normal = at<Vec<World::dimension, Real>>(std::sin(angle), std::cos(angle));
    fall(world, g);
    if (ground == Ground::collider)
        add_collider(
            world, {.shape = collide::HalfSpace<World::dimension, Real>{.normal = normal}, .friction = Real(friction)});
    else
        world.bounds.push_back({normal, 0, 0, Real(friction)});
}

/// A ball that touches that ground.
template <class World>
ParticleId add_ball(World& world, Ground ground, double angle,
                    ParticleSpec<World::dimension, typename World::Real> spec = {}) {
    using Real = typename World::Real;
    spec.position = at<Vec<World::dimension, Real>>(radius * std::sin(angle), radius * std::cos(angle));
    spec.radius = Real(radius);
    spec.figure = add_figure(world, "ball");
    set_contact(world, spec.figure, {.figures = ground == Ground::rows, .friction = 1});
    const auto id = add_particle(world, spec);
    world.figures[spec.figure].particles = {id};
    return id;
}

template <class World> double speed_of(const World& world, ParticleId id) {
    return double(norm(*velocity_of(world, id)));
}
/// Angular velocity about z.
template <class World> double spin_of(const World& world, ParticleId id) {
    return double(world.particles.spin[*row_of(world, id)][spins<World::dimension> - 1]);
}

/// Without slip a = g sin(angle) / (1 + inertia), which friction bears up to mu = tan(angle) inertia / (1 + inertia).
/// The way in 2 s by the discrete sum is a (t^2 + t h) / 2, 0.03 % more.
TYPED_TEST(Rolling, ABallRollsDownASlopeByItsInertia) {
    using World = typename TypeParam::World;
    using Real = typename World::Real;
    for (const auto ground : grounds)
        for (const double inertia : {solid_inertia<World::dimension>, 0.01, 1.0})
            for (const double angle : {0.1, pi<double> / 9}) {
                World world;
                add_slope(world, ground, angle, 0.5);
                const auto ball = add_ball(world, ground, angle, {.mass = Real(3), .inertia = Real(inertia)});
                run(world, 2);
                const double acceleration = g * std::sin(angle) / (1 + inertia);
                const auto away = *position_of(world, ball) -
                                  at<Vec<World::dimension, Real>>(radius * std::sin(angle), radius * std::cos(angle));
                EXPECT_NEAR(double(norm(away)), 2 * acceleration, 0.004 * 2 * acceleration) << inertia << " " << angle;
                EXPECT_NEAR(spin_of(world, ball) * radius, -speed_of(world, ball), 0.002 * speed_of(world, ball));
            }
}

/// Beyond that it slips: a = g (sin - mu cos), and its spin grows by mu g cos / (inertia radius).
TYPED_TEST(Rolling, OnASteepSlopeABallSlips) {
    using World = typename TypeParam::World;
    constexpr double angle = 1, mu = 0.1, inertia = solid_inertia<World::dimension>;
    for (const auto ground : grounds) {
        World world;
        add_slope(world, ground, angle, mu);
        const auto ball = add_ball(world, ground, angle);
        run(world, 1);
        EXPECT_NEAR(speed_of(world, ball), g * (std::sin(angle) - mu * std::cos(angle)), 0.03);
        EXPECT_NEAR(spin_of(world, ball) * radius, -mu * g * std::cos(angle) / inertia, 0.03 * mu * g / inertia);
    }
}

/// A ball that slides is at v / (1 + inertia) when it rolls, whatever the friction: its angular momentum about the
/// contact stays. So is one that spins, at the share inertia / (1 + inertia) of its rim's speed.
TYPED_TEST(Rolling, SlidingAndSpinningEndInRolling) {
    using World = typename TypeParam::World;
    using Real = typename World::Real;
    constexpr double inertia = solid_inertia<World::dimension>;
    for (const auto ground : grounds)
        for (const double mu : {0.2, 0.6})
            for (const bool slides : {true, false}) {
                World world;
                add_slope(world, ground, 0, mu);
                ParticleSpec<World::dimension, Real> spec;
                if (slides) spec.velocity = at<Vec<World::dimension, Real>>(3, 0);
                if (!slides)
                    spec.spin =
                        Vec<spins<World::dimension>, Real>::axis(spins<World::dimension> - 1) * Real(-3 / radius);
                const auto ball = add_ball(world, ground, 0, spec);
                run(world, 3);
                const double due = 3 * (slides ? 1 : inertia) / (1 + inertia);
                EXPECT_NEAR(speed_of(world, ball), due, 0.01 * due);
                EXPECT_NEAR(spin_of(world, ball) * radius, -due, 0.01 * due);
                const double kinetic = 0.5 * (1 + inertia) * due * due;
                EXPECT_NEAR(energy(world).kinetic, kinetic, 0.02 * kinetic);
            }
}

/// A ball that a conveyor carries along turns as a wheel on it does, the other way.
TYPED_TEST(Rolling, AConveyorSpinsABallThatIsHeld) {
    using World = typename TypeParam::World;
    using Real = typename World::Real;
    using Vector = Vec<World::dimension, Real>;
    World world;
    fall(world, g);
    const auto belt = add_collider(
        world, {.shape = collide::Box<World::dimension, Real>{Vector::map([](int i) { return Real(i == 0 ? 50 : 1); })},
                .friction = 1});
    const auto figure = add_figure(world, "cart");
    const auto hub = add_particle(
        world,
        {.position = at<Vector>(0, 1 + radius), .radius = Real(radius), .figure = figure, .rolls = Rolls::always});
    const auto post = add_particle(world, {.position = at<Vector>(-2, 1 + radius), .figure = figure});
    world.figures[figure].particles = {hub, post};
    pin(world, post);
    add<Distance>(world, {hub, post}, {.figure = figure});
    double x = 0;
    for (int i = 0; i < 120; ++i) {
        x += 2.0 / 60;
        move_collider(world, belt, {at<Vector>(x, 0), {}});
        step(world, Real(1.0 / 60));
    }
    EXPECT_NEAR(spin_of(world, hub) * radius, 2, 0.02);
    EXPECT_LT(speed_of(world, hub), 0.01);
}

/// Two balls that rub off centre keep momentum and angular momentum, and gain no energy.
TYPED_TEST(Rolling, BallsThatRubEachOtherKeepTheirAngularMomentum) {
    using World = typename TypeParam::World;
    using Real = typename World::Real;
    using Vector = Vec<World::dimension, Real>;
    World world;
    const auto add = [&](double x, double y, double vx, double mass) {
        const auto figure = add_figure(world, "ball" + std::to_string(world.figures.size()));
        set_contact(world, figure, {.figures = true, .friction = 0.4});
        world.figures[figure].particles = {add_particle(world, {.position = at<Vector>(x, y),
                                                                .velocity = at<Vector>(vx, 0),
                                                                .mass = Real(mass),
                                                                .radius = Real(radius),
                                                                .figure = figure})};
    };
    add(-0.6, 0.15, 2, 1);
    add(0.3, 0, -1, 3);
    const auto spin = angular_momentum(world)[2];
    const double energy_before = energy(world).kinetic;
    run(world, 1);
    const double tolerance = TypeParam::precise ? 1e-9 : 1e-5;
    EXPECT_NEAR(momentum(world)[0], -1, tolerance);
    EXPECT_NEAR(angular_momentum(world)[2], spin, tolerance);
    EXPECT_LE(energy(world).kinetic, energy_before * (1 + tolerance));
    EXPECT_GT(std::abs(double(world.particles.spin[0][spins<World::dimension> - 1])), 0.1);
}

/// A particle that a constraint holds does not roll unless it says so; in classic mode none does.
TYPED_TEST(Rolling, LooseParticlesRollAndOthersDoNot) {
    using World = typename TypeParam::World;
    using Real = typename World::Real;
    using Vector = Vec<World::dimension, Real>;
    for (const auto mode : {Mode::physical, Mode::classic}) {
        World world;
        world.settings.mode = mode;
        add_slope(world, Ground::plane, 0.2, 0.5);
        const auto loose = add_ball(world, Ground::plane, 0.2);
        const auto never = add_ball(world, Ground::plane, 0.2, {.rolls = Rolls::never});
        const auto a = add_ball(world, Ground::plane, 0.2), b = add_particle(world, {.position = at<Vector>(0, 1)});
        add<Distance>(world, {a, b});
        run(world, 0.5);
        EXPECT_EQ(spin_of(world, loose) != 0, mode == Mode::physical);
        for (const auto id : {never, a}) EXPECT_EQ(spin_of(world, id), 0);
        EXPECT_EQ(world.particles.turn[*row_of(world, never)], (collide::Rotation<World::dimension, Real>{}));
    }
}

/// The turn is the integral of the spin; hash and copies know both.
TYPED_TEST(Rolling, ATurnIsTheWayOverTheRadius) {
    using World = typename TypeParam::World;
    World world;
    add_slope(world, Ground::plane, 0, 0.5);
    auto spec = ParticleSpec<World::dimension, typename World::Real>{};
    spec.velocity[0] = 1;
    const auto ball = add_ball(world, Ground::plane, 0, spec);
    run(world, 1); // rolls
    const auto x = double((*position_of(world, ball))[0]);
    const auto before = world.particles.turn[*row_of(world, ball)];
    World copy = world;
    run(world, 0.5), run(copy, 0.5);
    EXPECT_EQ(state_hash(world), state_hash(copy));
    const double angle = (double((*position_of(world, ball))[0]) - x) / radius;
    const auto turned = world.particles.turn[*row_of(world, ball)] * before.inverse();
    const auto right = turned * at<Vec<World::dimension, typename World::Real>>(1, 0);
    EXPECT_NEAR(double(right[0]), std::cos(angle), 0.01);
    EXPECT_NEAR(double(right[1]), -std::sin(angle), 0.01);
    const auto hash = state_hash(world);
    EXPECT_TRUE(set_spin(world, ball, {}));
    EXPECT_NE(state_hash(world), hash);
}

// Neither 0 times infinity nor infinity less itself on the way.
TYPED_TEST(Rolling, ABallOfNearlyNoRadiusIsNoInvalidOperation) {
    using Real = typename TypeParam::World::Real;
    for (const Real nothing : {std::numeric_limits<Real>::denorm_min(), std::numeric_limits<Real>::min()})
        for (const double slide : {0.0, 1e-3, 10.0}) {
            typename TypeParam::World world;
            add_slope(world, Ground::plane, 0, 1);
            const auto ball = add_particle(world, {.radius = nothing, .rolls = Rolls::always});
            set_velocity(world, ball, at<typename TypeParam::World::Vector>(slide, -1));
            for (int i = 0; i < 60; ++i) {
                std::feclearexcept(FE_INVALID);
                step(world, Real(1.0 / 60));
#if !defined(__clang__) // which computes lanes of a vector that nobody reads
                ASSERT_EQ(std::fetestexcept(FE_INVALID), 0) << nothing << " " << slide << " " << i;
#endif
                ASSERT_TRUE(std::isfinite(spin_of(world, ball))) << nothing << " " << slide;
            }
        }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#include "sinew/math/random.h"
#include "sinew/world/edit.h"
#include "sinew/world/measure.h"

#include "tests/stepped.h"
#include "tests/worlds.h"

#include <cmath>

/// Internal damping: motion inside a figure decays, its flight and its spin stay.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class World> FigureIndex damped_figure(World& world, double rate) {
    const auto figure = add_figure(world, "damped" + std::to_string(world.figures.size()));
    world.figures[figure].internal_damping = rate;
    return figure;
}

struct Pair {
    ParticleId a, b;
    ConstraintId link;
};
/// Two particles on a slack link, moving apart at 1 m/s.
template <class World> Pair add_parting_pair(World& world, FigureIndex figure, double y = 0) {
    using Real = typename World::Real;
    using Vector = typename World::Vector;
    const auto a = add_particle(world, {.position = at<Vector>(0, y), .mass = Real(2), .figure = figure});
    const auto b = add_particle(world, {.position = at<Vector>(1, y), .velocity = at<Vector>(1, 0), .figure = figure});
    return {a, b, *add<Distance>(world, {a, b}, {.limits = at_most(Real(1000)), .figure = figure})};
}

/// A zigzag of particles on rigid links with random velocities.
template <class World> void add_wriggling_chain(World& world, FigureIndex figure) {
    using Real = typename World::Real;
    using Vector = typename World::Vector;
    std::vector<ParticleId> ids;
    for (int i = 0; i < 8; ++i) {
        auto position = at<Vector>(0.7 * i, 0.7 * (i % 2));
        for (int k = 2; k < World::dimension; ++k) position[k] = Real(0.2 * (i % 3));
        const auto speed =
            Vector::map([&](int k) { return random::symmetric<Real>(3, std::uint64_t(i), std::uint64_t(k)); });
        ids.push_back(
            add_particle(world, {.position = position, .velocity = speed, .mass = Real(1 + i % 3), .figure = figure}));
    }
    for (std::size_t i = 1; i < ids.size(); ++i) add<Distance>(world, {ids[i - 1], ids[i]}, {.figure = figure});
}

template <class Where> class InternalDampings : public ::testing::Test {};
TYPED_TEST_SUITE(InternalDampings, Everywhere, Names);

TYPED_TEST(InternalDampings, RelativeVelocityDecaysAtTheRateWhateverTheStep) {
    for (const double rate : {20.0, 60.0, 240.0}) {
        typename TypeParam::World world;
        const auto [a, b, link] = add_parting_pair(world, damped_figure(world, 2));
        run(world, 1.5, rate);
        const auto apart = *velocity_of(world, b) - *velocity_of(world, a);
        EXPECT_NEAR(double(apart[0]), std::exp(-2 * 1.5), TypeParam::precise ? 1e-12 : 1e-5) << rate;
        EXPECT_NEAR(momentum(world)[0], 1, TypeParam::precise ? 1e-12 : 1e-5) << rate;
    }
}

TYPED_TEST(InternalDampings, MomentaStayAndEnergyFalls) {
    typename TypeParam::World world;
    add_wriggling_chain(world, damped_figure(world, 3));
    const auto linear = momentum(world);
    const auto angular = angular_momentum(world);
    const double precision = TypeParam::precise ? 1e-7 : 2e-3; // links alone keep momenta to 2e-9 in 3D
    double before = energy(world).kinetic;
    for (int i = 0; i < 300; ++i) {
        run(world, 1.0 / 60);
        const double now = energy(world).kinetic;
        EXPECT_LE(now, before + precision) << i;
        before = now;
    }
    EXPECT_LT(norm(momentum(world) - linear), precision);
    EXPECT_LT(norm(angular_momentum(world) - angular), 10 * precision);
    EXPECT_LT(stretch(world).max, 1e-3);
}

// After a while the chain turns as if it were rigid, with the energy of a rigid body that has its momenta.
TYPED_TEST(InternalDampings, AWrigglingChainEndsAsARigidBody) {
    typename TypeParam::World world;
    add_wriggling_chain(world, damped_figure(world, 3));
    run(world, 20);
    const auto speed_between = [&](std::size_t i) {
        const auto& p = world.particles;
        const auto arm = p.position[i] - p.position[0];
        return std::abs(double(dot(arm, p.velocity[i] - p.velocity[0]))) / double(norm(arm));
    };
    for (std::size_t i = 1; i < world.particles.size(); ++i) EXPECT_LT(speed_between(i), 0.01) << i;
    EXPECT_GT(norm(angular_momentum(world)), 1.0);
}

// A rod of three particles in a line, in 3D too, and a single particle on a pin: their motion is that of a rigid body.
TYPED_TEST(InternalDampings, RigidMotionIsLeftAlone) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    const auto made = [](double rate) {
        typename TypeParam::World world;
        const auto rod = damped_figure(world, rate), bob = damped_figure(world, rate);
        std::vector<ParticleId> ids;
        for (int i = -1; i <= 1; ++i)
            ids.push_back(add_particle(
                world, {.position = at<Vector>(i, 0), .velocity = at<Vector>(0.5, 2.0 * i), .figure = rod}));
        add<Distance>(world, {ids[0], ids[1]}, {.figure = rod});
        add<Distance>(world, {ids[1], ids[2]}, {.figure = rod});
        add<Distance>(world, {ids[0], ids[2]}, {.figure = rod});
        const auto nail = add_particle(world, {.position = at<Vector>(0, 9), .figure = bob});
        pin(world, nail);
        const auto weight =
            add_particle(world, {.position = at<Vector>(1, 9), .velocity = at<Vector>(0, 3), .figure = bob});
        add<Distance>(world, {nail, weight}, {.figure = bob});
        run(world, 5);
        return world;
    };
    const auto free = made(0), damped = made(5);
    for (Row row = 0; row < free.particles.size(); ++row) {
        const auto difference = free.particles.velocity[row] - damped.particles.velocity[row];
        EXPECT_LT(norm(difference), Real(TypeParam::precise ? 1e-7 : 2e-3)) << row;
    }
}

TYPED_TEST(InternalDampings, PiecesOfACutFigurePartUnhindered) {
    typename TypeParam::World world;
    const auto figure = damped_figure(world, 2);
    const auto [a, b, link] = add_parting_pair(world, figure);
    run(world, 0.5);
    remove_constraints(world, std::array{link});
    const auto before = *velocity_of(world, b) - *velocity_of(world, a);
    run(world, 0.5);
    const auto after = *velocity_of(world, b) - *velocity_of(world, a);
    EXPECT_EQ(double(after[0]), double(before[0]));
}

// The damping keeps nothing between steps outside the world: a solver thrown away changes no bit.
TYPED_TEST(InternalDampings, IsStateOfTheWorld) {
    typename TypeParam::World kept;
    add_wriggling_chain(kept, damped_figure(kept, 1));
    add_parting_pair(kept, damped_figure(kept, 2), 50);
    auto thrown_away = kept;
    for (int i = 0; i < 60; ++i) {
        if (i == 30) kept.figures[0].internal_damping = thrown_away.figures[0].internal_damping = 0.5;
        run(kept, 1 / 60.0);
        thrown_away.solver = {};
        run(thrown_away, 1 / 60.0);
        ASSERT_EQ(state_hash(kept), state_hash(thrown_away)) << i;
    }
    auto other = kept;
    other.figures[1].internal_damping = 0;
    EXPECT_NE(state_hash(kept), state_hash(other));
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#include "tests/worlds.h"

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Bounds : ::testing::Test {};
TYPED_TEST_SUITE(Bounds, Everywhere, Names);

template <class World> void floor(World& world, double restitution, double friction, double angle = 0) {
    using Real = typename World::Real;
    const auto up = at<typename World::Vector>(-std::sin(angle), std::cos(angle));
    world.bounds.push_back({up, 0, Real(restitution), Real(friction)});
}

// Dropped from 1 m it comes back to e^2. The particle waits on the floor for the rest of the substep that it strikes
// in, which costs up to g h of its speed v = 4.47 m/s: with h = 1/1920 s, 0.12 % of v, 0.24 % of the height.
TYPED_TEST(Bounds, ABallBouncesToTheSquareOfItsRestitution) {
    using Real = typename TypeParam::Real;
    for (const double e : {0.0, 0.5, 0.8, 1.0}) {
        typename TypeParam::World world;
        fall(world, 10);
        floor(world, e, 0);
        const auto ball =
            add_particle(world, {.position = at<typename TypeParam::Vector>(0, 1.25), .radius = Real(0.25)});
        double highest = 0;
        for (int i = 0; i < 130; ++i) {
            step(world, Real(1.0 / 120));
            const double height = double((*position_of(world, ball))[1]) - 0.25;
            EXPECT_GE(height, -1e-6);
            if (i > 60) highest = std::max(highest, height);
        }
        EXPECT_LE(highest, e * e + 1e-4) << e;
        EXPECT_GE(highest, e * e * 0.995 - 1e-5) << e;
    }
}

TYPED_TEST(Bounds, WhatLiesOnTheFloorStaysThereWhateverItsRestitution) {
    typename TypeParam::World world;
    fall(world, 10);
    floor(world, 1, 0);
    const auto ball = add_particle(world, {});
    for (int i = 0; i < 100; ++i) {
        step(world, typename TypeParam::Real(1.0 / 60));
        EXPECT_NEAR((*position_of(world, ball))[1], 0, 1e-6);
    }
}

// The floor takes friction mu g h of speed in each substep: the way is v^2 / (2 mu g) but for one substep's, v h.
TYPED_TEST(Bounds, ASlidingBlockStopsAfterVSquaredOverTwoMuG) {
    using Vector = typename TypeParam::Vector;
    for (const double mu : {0.2, 0.5}) {
        typename TypeParam::World world;
        fall(world, 10);
        floor(world, 0, mu);
        const auto block = add_particle(world, {});
        run(world, 0.1); // at rest
        set_velocity(world, block, at<Vector>(3, 0));
        run(world, 3);
        EXPECT_NEAR((*position_of(world, block))[0], 9 / (2 * mu * 10), 3.0 / 960 + 1e-3) << mu;
        EXPECT_EQ((*velocity_of(world, block))[0], 0);
    }
}

// tan 30 degrees = 0.577. Held above it to rounding; below it a slides with g (sin - mu cos).
TYPED_TEST(Bounds, OnAnInclineItStaysWhenMuExceedsTheTangentAndSlidesOtherwise) {
    const double angle = pi<double> / 6;
    for (const double mu : {0.6, 0.3}) {
        typename TypeParam::World world;
        fall(world, 10);
        floor(world, 0, mu, angle);
        const auto block = add_particle(world, {});
        run(world, 1);
        const double way = double(norm(*position_of(world, block)));
        const double slide = mu < std::tan(angle) ? 0.5 * 10 * (std::sin(angle) - mu * std::cos(angle)) : 0;
        EXPECT_NEAR(way, slide, mu > std::tan(angle) ? 1e-4 : 0.005 * slide) << mu;
    }
}

TYPED_TEST(Bounds, NothingTunnelsHoweverFast) {
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    floor(world, 0, 0);
    const auto bullet = add_particle(
        world, {.position = at<typename TypeParam::Vector>(0, 1), .velocity = at<typename TypeParam::Vector>(0, -1e6)});
    step(world, Real(1.0 / 60));
    EXPECT_NEAR((*position_of(world, bullet))[1], 0, 1e-3);
}

// Six planes are a box; in every corner and whatever is pushed into it.
TYPED_TEST(Bounds, ABoxKeepsWhatIsInIt) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    typename TypeParam::World world;
    fall(world, 10);
    for (int axis = 0; axis < TypeParam::dimension; ++axis)
        for (const int side : {-1, 1})
            world.bounds.push_back({Vector::axis(axis) * Real(side), -2, Real(0.9), Real(0.1)});
    auto ids = chain(world, 10, at<Vector>(-1.8, 0), at<Vector>(0.4, 0));
    for (std::size_t i = 0; i < ids.size(); ++i) set_velocity(world, ids[i], at<Vector>(30.0 * double(i % 3), 50));
    for (int i = 0; i < 300; ++i) {
        step(world, Real(1.0 / 60));
        for (const auto& x : world.particles.position)
            for (int axis = 0; axis < TypeParam::dimension; ++axis) ASSERT_LE(std::abs(x[axis]), 2 + 1e-3);
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

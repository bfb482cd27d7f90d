#include "sinew/world/colliders.h"
#include "sinew/world/query.h"

#include "tests/worlds.h"

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Queries : ::testing::Test {};
TYPED_TEST_SUITE(Queries, Everywhere, Names);

/// Particles at x = 0, 1, 2, ... of radius 0.1, linked in a row.
template <class World> std::vector<ParticleId> row_of_balls(World& world, int count) {
    const auto ids = chain(world, count, {}, at<typename World::Vector>(1, 0));
    for (auto& radius : world.particles.radius) radius = typename World::Real(0.1);
    return ids;
}

TYPED_TEST(Queries, TheNearestParticleIsTheNearestSurface) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    const auto ids = row_of_balls(world, 5);
    const auto near = nearest_particle(world, at<Vector>(2.9, 0.4), Real(1));
    ASSERT_TRUE(near);
    EXPECT_EQ(near->particle, ids[3]);
    EXPECT_NEAR(double(near->distance), std::hypot(0.1, 0.4) - 0.1, 1e-6);
    EXPECT_FALSE(nearest_particle(world, at<Vector>(2.9, 0.4), Real(0.2)));
}

TYPED_TEST(Queries, TheNearestLinkTellsWhere) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    row_of_balls(world, 5);
    const auto near = nearest_link(world, at<Vector>(1.25, -0.5), Real(1));
    ASSERT_TRUE(near);
    EXPECT_NEAR(double(near->t), 0.25, 1e-6);
    EXPECT_NEAR(double(near->distance), 0.5, 1e-6);
    EXPECT_EQ(near->link.id.slot, 1U);
    EXPECT_FALSE(nearest_link(world, at<Vector>(1.25, -0.5), Real(0.4)));
}

TYPED_TEST(Queries, ARayMeetsTheFirstThing) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    World world;
    const auto ids = row_of_balls(world, 3);
    const auto wall = add_collider(
        world, collide::Collider<World::dimension, Real>{.shape = collide::Sphere<World::dimension, Real>{Real(0.5)},
                                                         .target = {at<Vector>(-2, 0), {}}});
    const auto to_ball = cast_ray(world, at<Vector>(4, 0), at<Vector>(-4, 0));
    ASSERT_TRUE(to_ball);
    EXPECT_FALSE(to_ball->is_collider);
    EXPECT_EQ(to_ball->particle, ids[2]);
    EXPECT_NEAR(double(to_ball->time), 1.9 / 4, 1e-5);
    const auto to_wall = cast_ray(world, at<Vector>(-4, 0.3), at<Vector>(10, 0));
    ASSERT_TRUE(to_wall);
    EXPECT_TRUE(to_wall->is_collider);
    EXPECT_EQ(to_wall->collider, wall);
    EXPECT_NEAR(double(to_wall->point[0]), -2.4, 1e-5);
    EXPECT_NEAR(double(cast_ray(world, at<Vector>(-4, 0), at<Vector>(10, 0), Real(0.25))->time), 0.125, 1e-5);
    EXPECT_FALSE(cast_ray(world, at<Vector>(-4, 0.3), at<Vector>(-10, 0)));
    EXPECT_FALSE(cast_ray(world, at<Vector>(-4, 0.3), at<Vector>(10, 0), Real(0), {.layers = 2, .mask = 2}));
}

TYPED_TEST(Queries, WhatOverlapsABoxIsListedInOrder) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    World world;
    const auto ids = row_of_balls(world, 6);
    const collide::Shape<World::dimension, Real> box = collide::Box<World::dimension, Real>{};
    const auto particles = overlapping_particles(world, box, {at<Vector>(2.55, 0.3), {}});
    EXPECT_EQ(particles, (std::vector<ParticleId>{ids[2], ids[3]})); // the box reaches from 2.05 to 3.05
    EXPECT_EQ(overlapping_links(world, box, {at<Vector>(2.55, 0.3), {}}).size(), 2U);
    EXPECT_TRUE(overlapping_links(world, box, {at<Vector>(2.55, 0.6), {}}).empty());
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

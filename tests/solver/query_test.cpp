#include "sinew/world/colliders.h"
#include "sinew/world/environment.h"
#include "sinew/world/query.h"

#include "tests/worlds.h"

#include <algorithm>
#include <cmath>

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
    EXPECT_EQ(near->link.id.index, 1U);
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

TYPED_TEST(Queries, ARayMeetsThePlanesOfTheWorld) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    World world;
    const auto ids = row_of_balls(world, 1); // a ball of radius 0.1 at the origin
    add_plane(world, {.normal = at<Vector>(0, 1), .offset = Real(-1)});
    const auto floor = cast_ray(world, at<Vector>(2, 1), at<Vector>(0, -4));
    ASSERT_TRUE(floor);
    EXPECT_TRUE(floor->is_plane);
    EXPECT_FALSE(floor->is_collider);
    EXPECT_NEAR(double(floor->time), 0.5, 1e-5);
    EXPECT_NEAR(double(floor->point[1]), -1, 1e-5);
    EXPECT_NEAR(double(floor->normal[1]), 1, 1e-5);
    EXPECT_NEAR(double(cast_ray(world, at<Vector>(2, 1), at<Vector>(0, -4), Real(0.2))->time), 0.45, 1e-5);
    EXPECT_FALSE(cast_ray(world, at<Vector>(2, 1), at<Vector>(0, 4)));
    EXPECT_EQ(cast_ray(world, at<Vector>(0, 1), at<Vector>(0, -4))->particle, ids[0]) << "what is nearer is met first";
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

// --- laws, against a search of everything by other means
// --------------------------------------------------------------

/// Particles of radius 0.05 to 0.15 anywhere in a cube of width 4, each linked to the next.
template <class World> std::vector<ParticleId> scatter(World& world, std::uint64_t seed, int count) {
    using Vector = typename World::Vector;
    using Real = typename World::Real;
    std::vector<ParticleId> ids;
    for (int i = 0; i < count; ++i) {
        const auto number = [&](int k) { return random::symmetric<Real>(seed, std::uint64_t(8 * i + k), 0); };
        ids.push_back(add_particle(world, {.position = Vector::map([&](int axis) { return Real(2) * number(axis); }),
                                           .radius = Real(0.1) + Real(0.05) * number(7)}));
    }
    for (std::size_t i = 0; i + 1 < ids.size(); ++i) add<Distance>(world, {ids[i], ids[i + 1]});
    return ids;
}
template <class Vector> Vector anywhere(std::uint64_t seed, std::uint64_t number) {
    using Real = std::remove_cvref_t<decltype(Vector{}[0])>;
    return Vector::map(
        [&](int axis) { return Real(2.5) * random::symmetric<Real>(seed, 8 * number + std::uint64_t(axis), 1); });
}
/// Distance of a point from a segment, which is convex along it: by ternary search.
template <class Vector> double tried_distance(const Vector& a, const Vector& b, const Vector& point) {
    const auto distance_at = [&](double share) {
        double sum = 0;
        for (int axis = 0; axis < int(a.component.size()); ++axis) {
            const double position = double(a[axis]) + (double(b[axis]) - double(a[axis])) * share;
            sum += (position - double(point[axis])) * (position - double(point[axis]));
        }
        return std::sqrt(sum);
    };
    double low = 0, high = 1;
    for (int i = 0; i < 100; ++i) {
        const double third = (high - low) / 3;
        distance_at(low + third) < distance_at(high - third) ? high -= third : low += third;
    }
    return distance_at(low);
}

TYPED_TEST(Queries, TheNearestOfManyIsThatOfASearchByHand) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    const auto ids = scatter(world, 7, 40);
    const auto& position = world.particles.position;
    for (std::uint64_t i = 0; i < 100; ++i) {
        const auto point = anywhere<Vector>(3, i);
        double nearest = 1e9, nearest_on_link = 1e9;
        for (std::size_t k = 0; k < ids.size(); ++k) {
            nearest =
                std::min(nearest, tried_distance(position[k], position[k], point) - double(world.particles.radius[k]));
            if (k > 0) nearest_on_link = std::min(nearest_on_link, tried_distance(position[k - 1], position[k], point));
        }
        for (const double reach : {0.3, 10.0}) {
            const auto particle = nearest_particle(world, point, Real(reach));
            ASSERT_EQ(particle.has_value(), nearest <= reach);
            if (particle) {
                EXPECT_NEAR(double(particle->distance), nearest, 1e-5);
            }
            if (std::abs(nearest_on_link - reach) < 1e-5) continue;
            const auto link = nearest_link(world, point, Real(reach));
            ASSERT_EQ(link.has_value(), nearest_on_link < reach);
            if (link) {
                EXPECT_NEAR(double(link->distance), nearest_on_link, 1e-5);
            }
        }
    }
}

TYPED_TEST(Queries, ARayStopsWhereAWalkDoes) {
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    typename TypeParam::World world;
    scatter(world, 11, 40);
    constexpr int paces = 4000;
    for (std::uint64_t i = 0; i < 60; ++i) {
        const auto from = anywhere<Vector>(5, 2 * i), to = anywhere<Vector>(5, 2 * i + 1);
        const double thick = i % 2 ? 0.07 : 0;
        if (const auto near = nearest_particle(world, from, Real(thick)); near)
            continue; // a start inside is no meeting
        int met = paces + 1;
        for (int pace = 0; pace <= paces && met > paces; ++pace) {
            const auto here = from + (to - from) * (Real(pace) / Real(paces));
            for (Row row = 0; row < world.particles.size(); ++row)
                if (double(distance(here, world.particles.position[row])) <
                    double(world.particles.radius[row]) + thick - 1e-4)
                    met = std::min(met, pace);
        }
        const auto hit = cast_ray(world, from, to - from, Real(thick));
        if (met <= paces) {
            ASSERT_TRUE(hit) << i;
            EXPECT_LE(double(hit->time), double(met) / paces + 1e-6);
            const auto center = *position_of(world, hit->particle);
            const double radius = double(world.particles.radius[*row_of(world, hit->particle)]);
            const auto stopped = from + (to - from) * hit->time;
            if (hit->time > Real(0)) {
                EXPECT_NEAR(double(distance(stopped, center)), radius + thick, 1e-4);
            }
            EXPECT_NEAR(double(norm(hit->normal)), 1, 1e-5);
        } else if (hit) { // grazes, within what the walk overlooks
            const auto center = *position_of(world, hit->particle);
            const double radius = double(world.particles.radius[*row_of(world, hit->particle)]);
            EXPECT_GT(tried_distance(from, to, center), radius + thick - 2e-4);
        }
    }
}

/// Distance of a point from a box, with the box turned back.
template <class Pose, class Vector>
double distance_from_box(const Pose& pose, const Vector& half, const Vector& point) {
    const auto local = pose.to_local(point);
    double sum = 0;
    for (int i = 0; i < int(half.component.size()); ++i) {
        const double outside = std::max(0.0, std::abs(double(local[i])) - double(half[i]));
        sum += outside * outside;
    }
    return std::sqrt(sum);
}
template <class TypeParam> collide::Pose<TypeParam::dimension, typename TypeParam::Real> turned(std::uint64_t i) {
    using Real = typename TypeParam::Real;
    const auto center = anywhere<typename TypeParam::Vector>(9, i);
    const Real angle = Real(0.1 * double(i));
    if constexpr (TypeParam::dimension == 2)
        return {center, collide::Rotation<2, Real>::of(angle)};
    else
        return {center, collide::Rotation<3, Real>::of({{1, 2, Real(i % 3)}}, angle)};
}

TYPED_TEST(Queries, ARegionHoldsWhatIsWithinIt) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    using Real = typename TypeParam::Real;
    constexpr int D = World::dimension;
    World world;
    const auto ids = scatter(world, 13, 60);
    const auto& position = world.particles.position;
    std::size_t max = 0;
    for (std::uint64_t i = 0; i < 60; ++i) {
        const auto pose = turned<TypeParam>(i);
        const auto half = at<Vector>(0.6, 0.3) + Vector::axis(D - 1) * Real(0.2);
        const auto in_box =
            overlapping_particles(world, collide::Shape<D, Real>{collide::Box<D, Real>{half * Real(2)}}, pose);
        const auto in_ball =
            overlapping_particles(world, collide::Shape<D, Real>{collide::Sphere<D, Real>{Real(0.7)}}, pose);
        const auto links = overlapping_links(world, collide::Shape<D, Real>{collide::Sphere<D, Real>{Real(0.7)}}, pose);
        max = std::max(max, in_box.size());
        for (Row row = 0; row < world.particles.size(); ++row) {
            const double radius = double(world.particles.radius[row]);
            const double from_box = distance_from_box(pose, half, position[row]) - radius;
            const double from_ball = double(distance(pose.position, position[row])) - 0.7 - radius;
            if (std::abs(from_box) > 1e-5) {
                EXPECT_EQ(std::count(in_box.begin(), in_box.end(), ids[row]), from_box < 0) << i << " " << row;
            }
            if (std::abs(from_ball) > 1e-5) {
                EXPECT_EQ(std::count(in_ball.begin(), in_ball.end(), ids[row]), from_ball < 0) << i << " " << row;
            }
        }
        std::size_t crossing = 0, close = 0;
        for (std::size_t k = 0; k + 1 < ids.size(); ++k) {
            const double apart = tried_distance(position[k], position[k + 1], pose.position) - 0.7;
            crossing += apart < 0;
            close += std::abs(apart) < 1e-3;
        }
        EXPECT_NEAR(double(links.size()), double(crossing), double(close)) << i;
    }
    EXPECT_GT(max, 0U);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

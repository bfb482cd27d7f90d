#include "sinew/world/colliders.h"

#include "tests/worlds.h"

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct Colliders : ::testing::Test {};
TYPED_TEST_SUITE(Colliders, Everywhere, Names);

template <class World> using ColliderOf = collide::Collider<World::dimension, typename World::Real>;
template <class World> using PoseOf = collide::Pose<World::dimension, typename World::Real>;
template <class World> using BoxOf = collide::Box<World::dimension, typename World::Real>;

template <class World> collide::Rotation<World::dimension, typename World::Real> turned(double angle) {
    using Real = typename World::Real;
    if constexpr (World::dimension == 2)
        return collide::Rotation<2, Real>::of(Real(angle));
    else
        return collide::Rotation<3, Real>::of({{0, 0, 1}}, Real(angle));
}

/// A box about `position`, turned about the z axis.
template <class World>
ColliderId add_box(World& world, double width, double height, typename World::Vector position, double angle = 0,
                   ColliderOf<World> like = {}) {
    using Real = typename World::Real;
    like.shape = BoxOf<World>{World::Vector::map([&](int i) { return Real(i == 0 ? width : i == 1 ? height : 10); })};
    like.target = {position, turned<World>(angle)};
    return add_collider(world, like);
}

template <class World> double height_of(const World& world, ParticleId id) {
    return double((*position_of(world, id))[1]);
}

// The law of bounds_test.cpp, on a box.
TYPED_TEST(Colliders, ABallBouncesToTheSquareOfItsRestitution) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    for (const double e : {0.0, 0.5, 0.8, 1.0}) {
        World world;
        fall(world, 10);
        add_box(world, 2, 2, at<typename TypeParam::Vector>(0, -1), 0, {.restitution = Real(e)});
        const auto ball =
            add_particle(world, {.position = at<typename TypeParam::Vector>(0, 1.25), .radius = Real(0.25)});
        double highest = 0;
        for (int i = 0; i < 130; ++i) {
            step(world, Real(1.0 / 120));
            const double height = height_of(world, ball) - 0.25;
            EXPECT_GE(height, -1e-6);
            if (i > 60) highest = std::max(highest, height);
        }
        EXPECT_LE(highest, e * e + 1e-4) << e;
        EXPECT_GE(highest, e * e * 0.995 - 1e-5) << e;
    }
}

// A particle on a slope of angle a slides if and only if tan a > mu, and then with g (sin a - mu cos a).
TYPED_TEST(Colliders, FrictionHoldsUpToItsAngleAndNotBeyond) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    for (const double mu : {0.2, 0.5, 0.8}) {
        const double steepest = std::atan(mu), degree = pi<double> / 180;
        for (const double beyond : {-0.5 * degree, 0.5 * degree, 10 * degree}) {
            World world;
            fall(world, 10);
            const double angle = steepest + beyond;
            const auto up = at<typename TypeParam::Vector>(-std::sin(angle), std::cos(angle));
            add_box(world, 100, 2, up * Real(-1), angle, {.friction = Real(mu)});
            const auto block =
                add_particle(world, {.position = up * Real(0.1), .radius = Real(0.1), .rolls = Rolls::never});
            run(world, 0.2);
            const auto begun = *position_of(world, block);
            const double speed = double(norm(*velocity_of(world, block)));
            run(world, 1);
            const double way = double(norm(*position_of(world, block) - begun));
            const double acceleration = 10 * (std::sin(angle) - mu * std::cos(angle));
            const double expected = beyond < 0 ? 0 : speed + acceleration / 2;
            EXPECT_NEAR(way, expected, 0.02 * expected + 1e-5) << mu << " " << beyond;
        }
    }
}

// Blocks compute with colliders in doubles: in floats their contacts never settled, and crates stuck to slopes.
TYPED_TEST(Colliders, ABlockSlidesDownASlopeAsFastAsItShould) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    const double mu = 0.3, angle = std::atan(mu) + 8 * pi<double> / 180;
    typename TypeParam::World world;
    fall(world, 10);
    const auto up = at<Vector>(-std::sin(angle), std::cos(angle)), along = at<Vector>(std::cos(angle), std::sin(angle));
    add_box(world, 100, 2, up * Real(-1), angle, {.friction = Real(mu)});
    world.figures[add_figure(world, "crate")].direct = Direct::on;
    std::vector<ParticleId> corners;
    for (const auto& [x, y] : {std::pair{-1, 0}, {1, 0}, {1, 1}, {-1, 1}})
        corners.push_back(add_particle(
            world, {.position = along * Real(0.5 * x) + up * Real(0.02 + 0.5 * y), .radius = Real(0.02), .figure = 0}));
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = 0; k < i; ++k) add<Distance>(world, {corners[i], corners[k]}, {.figure = 0});
    run(world, 0.2);
    const double speed = double(norm(*velocity_of(world, corners[0])));
    run(world, 1);
    const double acceleration = 10 * (std::sin(angle) - mu * std::cos(angle));
    EXPECT_NEAR(double(norm(*velocity_of(world, corners[0]))), speed + acceleration, 0.02 * acceleration);
}

// An overlap at the start is left at the speed of a body thrown up from its bottom, by swept particles and by blocks.
TYPED_TEST(Colliders, AnOverlapIsLeftWithoutABurst) {
    using Real = typename TypeParam::Real;
    using Vector = typename TypeParam::Vector;
    for (const bool is_bound : {false, true})
        for (const double depth : {0.001, 0.05, 0.5}) {
            typename TypeParam::World world;
            fall(world, 10);
            if (is_bound)
                world.bounds.push_back({at<Vector>(0, 1)});
            else
                add_box(world, 100, 20, at<Vector>(0, -10), 0, {});
            const auto ball = add_particle(world, {.position = at<Vector>(3, 0.1 - depth), .radius = Real(0.1)});
            chain(world, 4, at<Vector>(-3, -depth), at<Vector>(0.5, 0));
            double fastest = 0, highest = 0;
            for (int i = 0; i < 60; ++i) {
                run(world, 1 / 60.0);
                for (const auto& velocity : world.particles.velocity)
                    fastest = std::max(fastest, double(norm(velocity)));
                highest = std::max(highest, height_of(world, ball));
            }
            EXPECT_LT(fastest, 1.05 * std::sqrt(20 * depth) + 0.01) << depth;
            EXPECT_LT(highest, 0.1 + 0.1 * depth + 1e-3) << depth;
            for (Row row = 0; row < world.particles.size(); ++row)
                EXPECT_GT(double(world.particles.position[row][1] - world.particles.radius[row]), -2e-3)
                    << depth << row;
        }
}

/// One shape of each kind about the origin, 0.02 thick at least.
template <int D, class Real> std::vector<collide::Shape<D, Real>> thin_shapes() {
    using V = Vec<D, Real>;
    constexpr auto thin = Real(0.01);
    std::vector<collide::Shape<D, Real>> shapes = {
        collide::Box<D, Real>{V::map([](int i) { return Real(i == 1 ? 0.02 : 6); })},
        collide::HalfSpace<D, Real>{V::axis(1), 0},
        collide::Capsule<D, Real>{V::axis(0) * Real(-3), V::axis(0) * Real(3), Real(0.01)},
    };
    if constexpr (D == 2) {
        shapes.push_back(collide::Chain<2, Real>{{{{-3, 0}}, {{-1, 0}}, {{0.5, 0}}, {{3, 0}}}});
        shapes.push_back(collide::Polygon<2, Real>{{{{-3, -thin}}, {{3, -thin}}, {{3, thin}}, {{-3, thin}}}});
    } else {
        shapes.push_back(
            collide::Mesh<3, Real>{{{{-3, 0, -3}}, {{3, 0, -3}}, {{3, 0, 3}}, {{-3, 0, 3}}}, {{0, 2, 1}, {0, 3, 2}}});
        shapes.push_back(
            collide::HeightField<3, Real>{.columns = 13, .spacing = 10, .height = std::vector<Real>(169, Real(0))});
    }
    return shapes;
}

// 1000 m/s is 1 m a substep, 50 times as far as the wall is thick. A direct block steps 8 m at a time, and is stopped
// by a stiff spring, which gives way a little and then pushes out. The landscape is so wide that nothing leaves it over
// its rim.
TYPED_TEST(Colliders, NothingTunnelsAtAThousandMetresASecond) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    for (const auto& shape : thin_shapes<TypeParam::dimension, Real>())
        for (const double radius : {0.0, 0.005, 0.1, 0.4})
            for (int i = 0; i < 20; ++i) {
                World world;
                ColliderOf<World> wall{.shape = shape};
                if (shape.index() == 5 && TypeParam::dimension == 3)
                    wall.target.position = Vector::map([](int k) { return Real(k == 1 ? 0 : -60); });
                add_collider(world, wall);
                const double slant = 1.5 * random::symmetric(1, 2, std::uint64_t(i));
                const auto predicted = at<Vector>(0.3 * random::symmetric(1, 3, std::uint64_t(i)), 0);
                const auto way = direction(at<Vector>(slant, -1));
                const auto bullet = add_particle(
                    world, {.position = predicted - way * Real(1 + 3 * random::uniform(1, 4, std::uint64_t(i))),
                            .velocity = way * Real(1000),
                            .radius = Real(radius)});
                // a rod of two particles, solved directly, beside it
                const auto rod = chain(world, 3, predicted - way * Real(2), at<Vector>(0.1, 0.05));
                for (const auto id : rod) set_velocity(world, id, way * Real(1000));
                for (int k = 0; k < 3; ++k) step(world, Real(1.0 / 60));
                EXPECT_GT(height_of(world, bullet), -1e-3) << shape.index() << " " << radius << " " << i;
                for (const auto id : rod) EXPECT_GT(height_of(world, id), -1e-3) << shape.index() << " rod " << i;
            }
}

TYPED_TEST(Colliders, AMovingPlatformCarriesWhatLiesOnIt) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    for (const auto& velocity : {at<Vector>(0.5, 0), at<Vector>(0, 0.4), at<Vector>(-0.3, -0.2)}) {
        World world;
        fall(world, 10);
        const auto platform = add_box(world, 4, 0.2, at<Vector>(0, -0.1), 0, {.friction = 1});
        const auto ball =
            add_particle(world, {.position = at<Vector>(0, 0.1), .radius = Real(0.1), .rolls = Rolls::never});
        const auto rod = chain(world, 3, at<Vector>(0.5, 0), at<Vector>(0.2, 0));
        run(world, 0.2);
        const auto begun = *position_of(world, ball), rod_begun = *position_of(world, rod[1]);
        PoseOf<World> pose = find_collider(world, platform)->target;
        for (int i = 0; i < 60; ++i) {
            pose.position += velocity * Real(1.0 / 60);
            EXPECT_TRUE(move_collider(world, platform, pose));
            step(world, Real(1.0 / 60));
        }
        EXPECT_NEAR(double(distance(*position_of(world, ball) - begun, velocity)), 0, 0.03);
        EXPECT_NEAR(double(distance(*position_of(world, rod[1]) - rod_begun, velocity)), 0, 0.03);
        EXPECT_NEAR(double(distance(*velocity_of(world, ball), velocity)), 0, 1e-3);
    }
}

// A wheel turns under a ball that a groove of two boxes keeps in place: the surface runs below it.
TYPED_TEST(Colliders, ATurningShapeDragsWithItsSurface) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    World world;
    fall(world, 10);
    const auto wheel = add_box(world, 20, 2, at<Vector>(0, -1), 0, {.friction = Real(0.5)});
    const auto block = add_particle(world, {.position = at<Vector>(0, 0)});
    run(world, 0.1);
    const double rate = 0.2;
    for (int i = 1; i <= 30; ++i) {
        move_collider(world, wheel, {at<Vector>(0, -1), turned<World>(rate * i / 60)});
        step(world, Real(1.0 / 60));
    }
    // a point at the top of the box runs to the left with rate * 1 m
    EXPECT_NEAR(double((*velocity_of(world, block))[0]), -rate, 0.02 * rate);
}

TYPED_TEST(Colliders, AOneWayPlatformIsPassedFromBelow) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    World world;
    fall(world, 10);
    add_box(world, 4, 0.2, at<Vector>(0, -0.1), 0, {.one_way = at<Vector>(0, 1)});
    const auto jumper =
        add_particle(world, {.position = at<Vector>(0, -1), .velocity = at<Vector>(0, 7), .radius = Real(0.1)});
    double highest = -1;
    for (int i = 0; i < 180; ++i) {
        step(world, Real(1.0 / 60));
        highest = std::max(highest, height_of(world, jumper));
    }
    EXPECT_NEAR(highest, -1 + 4.9 / 2, 0.02);
    EXPECT_NEAR(height_of(world, jumper), 0.1, 1e-6);
}

TYPED_TEST(Colliders, ASensorReportsAndDoesNotPush) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    World world;
    const auto gate = add_box(world, 1, 1, at<Vector>(0, 0), 0, {.is_sensor = true});
    const auto ball = add_particle(world, {.position = at<Vector>(-1, 0), .velocity = at<Vector>(1, 0)});
    std::vector<std::pair<EventType, int>> told;
    for (int i = 0; i < 180; ++i) {
        step(world, Real(1.0 / 60));
        for (const auto& event : world.events) {
            EXPECT_EQ(event.collider, gate);
            EXPECT_EQ(event.particle, ball);
            told.push_back({event.type, i});
        }
    }
    EXPECT_NEAR(double((*position_of(world, ball))[0]), 2, 1e-5);
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[0].first, EventType::touched);
    EXPECT_NEAR(told[0].second, 30, 1);
    EXPECT_EQ(told[1].first, EventType::parted);
    EXPECT_NEAR(told[1].second, 90, 1);
}

TYPED_TEST(Colliders, ABlowReportsItsImpulse) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    World world;
    add_box(world, 4, 2, at<Vector>(0, -1));
    add_particle(world,
                 {.position = at<Vector>(0, 0.11), .velocity = at<Vector>(0, -6), .mass = 2, .radius = Real(0.1)});
    double impulse = 0;
    for (int i = 0; i < 10; ++i) {
        step(world, Real(1.0 / 60));
        for (const auto& event : world.events)
            if (event.type == EventType::touched) impulse = std::max(impulse, event.impulse);
    }
    EXPECT_NEAR(impulse, 12, 0.01 * 12);
}

TYPED_TEST(Colliders, LayersThatDoNotMeetPass) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    World world;
    fall(world, 10);
    add_box(world, 40, 2, at<Vector>(0, -1), 0, {.filter = {.layers = 2, .mask = 4}});
    const auto meeting = add_figure(world, "meeting"), passing = add_figure(world, "passing");
    world.figures[meeting].filter = {.layers = 4, .mask = 2};
    world.figures[passing].filter = {.layers = 4, .mask = 1};
    const auto stays = add_particle(world, {.position = at<Vector>(0, 1), .figure = meeting});
    const auto falls = add_particle(world, {.position = at<Vector>(1, 1), .figure = passing});
    run(world, 2);
    EXPECT_NEAR(height_of(world, stays), 0, 1e-6);
    EXPECT_LT(height_of(world, falls), -15);
}

TYPED_TEST(Colliders, ARemovedColliderHoldsNothing) {
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    World world;
    fall(world, 10);
    const auto below = add_box(world, 4, 2, at<Vector>(0, -5));
    const auto floor = add_box(world, 4, 2, at<Vector>(0, -1));
    const auto ball = add_particle(world, {.position = at<Vector>(0, 0.5)});
    run(world, 1);
    EXPECT_NEAR(height_of(world, ball), 0, 1e-6);
    EXPECT_TRUE(remove_collider(world, floor));
    EXPECT_FALSE(remove_collider(world, floor));
    EXPECT_FALSE(move_collider(world, floor, {}));
    EXPECT_EQ(find_collider(world, floor), nullptr);
    EXPECT_NE(find_collider(world, below), nullptr);
    run(world, 2);
    EXPECT_NEAR(height_of(world, ball), -4, 1e-6);
}

// A world with colliders is a value: its copy has the same future, whatever the number of threads.
TYPED_TEST(Colliders, CopiesHaveTheSameFuture) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    World world;
    fall(world, 10);
    add_box(world, 6, 1, at<Vector>(0, -1), 0.2, {.restitution = Real(0.5), .friction = Real(0.3)});
    const auto post = add_collider(
        world, ColliderOf<World>{.shape = collide::Sphere<World::dimension, Real>{Real(0.4)}, .friction = Real(0.4)});
    chain(world, 12, at<Vector>(-1, 0.6), at<Vector>(0.2, 0));
    for (int i = 0; i < 30; ++i)
        add_particle(world, {.position = at<Vector>(-2 + 0.13 * i, 1 + 0.07 * i), .radius = Real(0.05)});
    for (int i = 0; i < 90; ++i) {
        if (i % 2) move_collider(world, post, {at<Vector>(0.01 * i, 0), turned<World>(0.02 * i)});
        World copy = world;
        copy.solver.options.threads = 3;
        step(world, Real(1.0 / 60));
        step(copy, Real(1.0 / 60));
        ASSERT_EQ(state_hash(copy), state_hash(world)) << i;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

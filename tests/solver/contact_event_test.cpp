#include "sinew/world/colliders.h"

#include "tests/crates.h"
#include "tests/worlds.h"

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Type> struct ContactEvents : ::testing::Test {};
TYPED_TEST_SUITE(ContactEvents, Everywhere, Names);

/// A ball of 1 kg flies at 4 m/s at another one that rests.
template <class Type> struct Blow {
    using Real = typename Type::Real;
    using Vector = typename Type::Vector;
    typename Type::World world;
    FigureIndex one = ball(-1, 4), two = ball(0, 0);

    FigureIndex ball(double x, double speed) {
        const auto figure = add_figure(world, x < 0 ? "one" : "two");
        set_contact(world, figure, {.figures = true, .friction = 0});
        const auto id = add_particle(
            world,
            {.position = at<Vector>(x, 0), .velocity = at<Vector>(speed, 0), .radius = Real(0.2), .figure = figure});
        world.figures[figure].particles.push_back(id);
        return figure;
    }
    ParticleId particle(FigureIndex figure) const { return world.figures[figure].particles[0]; }
    /// Events of a type in so many steps.
    std::vector<Event> collect(EventType type, int steps) {
        std::vector<Event> found;
        for (int i = 0; i < steps; ++i) {
            step(world, Real(1.0 / 60));
            for (const auto& event : world.events)
                if (event.type == type) found.push_back(event);
        }
        return found;
    }
};

// Both go on at half the speed: the blow of equal masses is half of the momentum.
TYPED_TEST(ContactEvents, ABlowBeginsOnceWithItsImpulse) {
    Blow<TypeParam> blow;
    blow.world.contacts.lists_figures = true;
    const auto began = blow.collect(EventType::touched, 60);
    ASSERT_EQ(began.size(), 1U);
    EXPECT_EQ(began[0].figure, blow.one);
    EXPECT_EQ(began[0].other, blow.two);
    EXPECT_EQ(began[0].particle, blow.particle(blow.one));
    EXPECT_EQ(began[0].other_particle, blow.particle(blow.two));
    EXPECT_GT(began[0].impulse, 0);
}

TYPED_TEST(ContactEvents, AHitIsABlowAboveAThreshold) {
    for (const double threshold : {1.9, 2.1}) {
        Blow<TypeParam> blow;
        blow.world.contacts.lists_figures = true;
        blow.world.contacts.hit_impulse = threshold;
        const auto hits = blow.collect(EventType::hit, 60);
        EXPECT_EQ(hits.size(), threshold < 2 ? 1U : 0U);
        for (const auto& hit : hits) EXPECT_NEAR(hit.impulse, 2, 0.02);
    }
}

TYPED_TEST(ContactEvents, AreNotListedUnlessAskedAndChangeNothing) {
    Blow<TypeParam> asked, other;
    asked.world.contacts.lists_figures = true;
    EXPECT_FALSE(asked.collect(EventType::touched, 60).empty());
    EXPECT_TRUE(other.collect(EventType::touched, 60).empty());
    EXPECT_TRUE(other.world.contacts.figures.empty());
    EXPECT_EQ(state_hash(asked.world), state_hash(other.world));
}

/// A crate that lies on another one, on the ground; then the ground is gone and the upper one is thrown up.
TYPED_TEST(ContactEvents, ATouchPersistsWhileItLastsAndThenEnds) {
    using Real = typename TypeParam::Real;
    if constexpr (TypeParam::dimension == 2) {
        FlatWorld<Real> world;
        add_ground(world);
        world.contacts.lists_figures = true;
        add_crate(world, 0, 0.5, 1, 1);
        const auto upper = add_crate(world, 0, 1.5, 1, 1);
        run(world, 2);
        ASSERT_EQ(world.contacts.figures.size(), 1U);
        const auto touch = world.contacts.figures[0];
        EXPECT_FALSE(touch.strength.is_new);
        EXPECT_NEAR(touch.strength.impulse, 10.0 / 60, 0.05 * 10 / 60) << "carries a weight of 10 N";
        EXPECT_NEAR(touch.strength.blow, touch.strength.impulse, 0.05 * 10 / 60);
        for (const auto& event : world.events) EXPECT_NE(event.type, EventType::touched);
        for (const auto id : upper) set_velocity(world, id, {{0, 5}});
        int ended = 0;
        for (int i = 0; i < 20; ++i) {
            step(world, Real(1.0 / 60));
            for (const auto& event : world.events)
                ended += event.type == EventType::parted && event.figure == touch.first && event.other == touch.second;
        }
        EXPECT_EQ(ended, 1);
        EXPECT_TRUE(world.contacts.figures.empty());
    }
}

TYPED_TEST(ContactEvents, SleepersTouchAsBefore) {
    using Real = typename TypeParam::Real;
    if constexpr (TypeParam::dimension == 2) {
        FlatWorld<Real> world;
        add_ground(world);
        world.settings.sleep = {.speed = Real(0.05), .delay = Real(0.5)};
        world.contacts.lists_figures = true;
        add_crate(world, 0, 0.5, 1, 1);
        add_crate(world, 0, 1.5, 1, 1);
        run(world, 4);
        ASSERT_NE(world.particles.asleep[0], 0);
        EXPECT_EQ(world.contacts.figures.size(), 1U);
        for (int i = 0; i < 60; ++i) {
            step(world, Real(1.0 / 60));
            EXPECT_TRUE(world.events.empty());
        }
        EXPECT_EQ(world.contacts.figures.size(), 1U);
    }
}

// The impulses of a ball that lies on a floor carry its weight.
TYPED_TEST(ContactEvents, AColliderCarriesAWeight) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    World world;
    fall(world, 10);
    add_collider(world, collide::Collider<World::dimension, Real>{
                            .shape = collide::HalfSpace<World::dimension, Real>{.normal = at<Vector>(0, 1)}});
    add_particle(world, {.position = at<Vector>(0, 0.1), .mass = 3, .radius = Real(0.1)});
    run(world, 1);
    ASSERT_EQ(world.contacts.touching.size(), 1U);
    const auto& strength = world.contacts.touching[0].strength;
    EXPECT_FALSE(strength.is_new);
    EXPECT_NEAR(strength.impulse, 30.0 / 60, 0.02 * 30 / 60);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

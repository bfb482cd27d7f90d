#include "sinew/world/colliders.h"
#include "sinew/world/environment.h"

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

// --- planes of the world ---------------------------------------------------------------------------------------------

/// A ball of 3 kg that falls from 0.1 above the ground: a plane of the world, or a collider.
template <class Type> struct Fall {
    using Real = typename Type::Real;
    using Vector = typename Type::Vector;
    using World = typename Type::World;
    World world;
    std::vector<Event> events;
    std::vector<double> impulses; ///< of the touch after each step; 0 without one

    explicit Fall(bool onto_plane) {
        fall(world, 10);
        const auto up = at<Vector>(0, 1);
        if (onto_plane)
            add_plane(world, {.normal = up});
        else
            add_collider(world, collide::Collider<World::dimension, Real>{
                                    .shape = collide::HalfSpace<World::dimension, Real>{.normal = up}});
        world.contacts.lists_planes = true;
        world.contacts.hit_impulse = 3;
    }
    void go_on(double seconds) {
        for (int i = 0; i < int(60 * seconds); ++i) {
            step(world, Real(1.0 / 60));
            events.insert(events.end(), world.events.begin(), world.events.end());
            const auto& touching = world.contacts.touching;
            impulses.push_back(touching.empty() ? 0 : touching[0].strength.impulse);
        }
    }
    std::string told() const {
        std::string text;
        for (const auto& event : events)
            text += event.type == EventType::touched ? "touched " : event.type == EventType::hit ? "hit " : "parted ";
        return text;
    }
};

template <class Type> void expect_planes_report_as_colliders(void (*fill)(Fall<Type>&)) {
    Fall<Type> plane(true), collider(false);
    for (auto* fallen : {&plane, &collider}) {
        fill(*fallen);
        fallen->go_on(1);
        fallen->world.forces.clear();
        fallen->world.forces.push_back(
            Gravity<Type::dimension, typename Type::Real>{at<typename Type::Vector>(0, 10)}); // and up again
        fallen->go_on(1);
    }
    EXPECT_EQ(plane.told(), "touched hit parted ");
    EXPECT_EQ(plane.told(), collider.told());
    for (const auto& event : plane.events) {
        EXPECT_TRUE(is_plane(event.collider.index));
        EXPECT_EQ(event.collider.index & ~plane_bit, 0U);
    }
    EXPECT_NEAR(plane.impulses[50], 30.0 / 60, 0.02 * 30 / 60) << "the weight";
    EXPECT_NEAR(plane.impulses[50], collider.impulses[50], 0.02 * 30 / 60);
}

TYPED_TEST(ContactEvents, APlaneReportsASweptBallAsAColliderDoes) {
    expect_planes_report_as_colliders<TypeParam>([](Fall<TypeParam>& fallen) {
        using Real = typename TypeParam::Real;
        add_particle(fallen.world,
                     {.position = at<typename TypeParam::Vector>(0, 0.2), .mass = 3, .radius = Real(0.1)});
    });
}

TYPED_TEST(ContactEvents, APlaneReportsABallOfAFigureWithContactsAsAColliderDoes) {
    expect_planes_report_as_colliders<TypeParam>([](Fall<TypeParam>& fallen) {
        using Real = typename TypeParam::Real;
        const auto figure = add_figure(fallen.world, "ball");
        set_contact(fallen.world, figure, {.figures = true});
        const auto id = add_particle(
            fallen.world,
            {.position = at<typename TypeParam::Vector>(0, 0.2), .mass = 3, .radius = Real(0.1), .figure = figure});
        fallen.world.figures[figure].particles.push_back(id);
    });
}

// A rope of two links falls flat: each of its three particles begins once, and the plane carries them.
TYPED_TEST(ContactEvents, APlaneReportsTheParticlesOfABlock) {
    using Real = typename TypeParam::Real;
    Fall<TypeParam> fallen(true);
    std::vector<ParticleId> row;
    for (int i = 0; i < 3; ++i)
        row.push_back(add_particle(fallen.world,
                                   {.position = at<typename TypeParam::Vector>(0.5 * i, 0.2), .radius = Real(0.1)}));
    for (std::size_t i = 0; i < 2; ++i) add<Distance>(fallen.world, {row[i], row[i + 1]});
    fallen.go_on(1);
    int began = 0;
    for (const auto& event : fallen.events) began += event.type == EventType::touched;
    EXPECT_EQ(began, 3);
    ASSERT_EQ(fallen.world.contacts.touching.size(), 3U);
    for (const auto& touch : fallen.world.contacts.touching) EXPECT_GT(touch.strength.impulse, 0);
}

// Whoever does not ask pays nothing, and the state is the same to the bit.
TYPED_TEST(ContactEvents, PlanesAreSilentUntilAskedAndNeverPartOfTheState) {
    Fall<TypeParam> asked(true), silent(true);
    silent.world.contacts.lists_planes = false;
    for (auto* fallen : {&asked, &silent}) {
        add_particle(
            fallen->world,
            {.position = at<typename TypeParam::Vector>(0, 0.2), .mass = 3, .radius = typename TypeParam::Real(0.1)});
        fallen->go_on(1);
    }
    EXPECT_TRUE(silent.events.empty());
    EXPECT_TRUE(silent.world.contacts.touching.empty());
    EXPECT_EQ(state_hash(asked.world), state_hash(silent.world));
    asked.world.bounds.clear();
    asked.events.clear();
    asked.go_on(0.1);
    EXPECT_TRUE(asked.world.contacts.touching.empty()) << "a plane that is gone is not touched";
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

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

/// Bodies that fall flat on a floor with a restitution, their links along the floor.
enum class Fallen { swept_ball, rows_ball, block_rope, rows_rope, block_crate, rows_crate };
constexpr std::array all_fallen = {Fallen::swept_ball, Fallen::rows_ball,   Fallen::block_rope,
                                   Fallen::rows_rope,  Fallen::block_crate, Fallen::rows_crate};

template <class World> void add_fallen(World& world, Fallen kind, double height) {
    using Real = typename World::Real;
    using Vector = Vec<World::dimension, Real>;
    const auto figure = add_figure(world, "fallen");
    if (int(kind) % 2 == 1) set_contact(world, figure, {.figures = true, .friction = 0});
    world.figures[figure].direct = Direct::on;
    std::vector<ParticleId> ids;
    const int columns = int(kind) < 2 ? 1 : int(kind) < 4 ? 6 : 2, rows = int(kind) < 4 ? 1 : 2;
    for (int i = 0; i < columns; ++i)
        for (int k = 0; k < rows; ++k)
            ids.push_back(add_particle(world, {.position = at<Vector>(0.5 * i, height + 0.5 * k),
                                               .mass = Real(0.5),
                                               .radius = Real(0.05),
                                               .figure = figure}));
    world.figures[figure].particles = ids;
    if (rows == 2)
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = i + 1; k < 4; ++k) add<Distance>(world, {ids[i], ids[k]}, {.figure = figure});
    else
        for (std::size_t i = 1; i < ids.size(); ++i) add<Distance>(world, {ids[i - 1], ids[i]}, {.figure = figure});
}
template <class World> double upward_momentum(const World& world) {
    double sum = 0;
    for (Row row = 0; row < world.particles.size(); ++row)
        if (world.particles.inverse_mass[row] > 0)
            sum += double(world.particles.velocity[row][1]) / double(world.particles.inverse_mass[row]);
    return sum;
}

// The impulses of each step are the change of momentum, but for the weight: of the blow, of its rebound and of rest.
TYPED_TEST(ContactEvents, ImpulsesAreTheChangeOfMomentum) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    for (const auto kind : all_fallen)
        for (const double e : {0.0, 0.5, 1.0}) {
            World world;
            fall(world, 10);
            add_collider(world, collide::Collider<World::dimension, Real>{
                                    .shape = collide::HalfSpace<World::dimension, Real>{.normal = at<Vector>(0, 1)},
                                    .restitution = Real(e)});
            add_fallen(world, kind, 1.3);
            const double weight = 5 * double(world.particles.size()), blow = weight / 10 * 5 * (1 + e);
            double before = 0, total = 0;
            for (int i = 0; i < 60; ++i) {
                step(world, Real(1.0 / 60));
                const double now = upward_momentum(world), due = now - before + weight / 60;
                double told = 0;
                for (const auto& touch : world.contacts.touching) told += touch.strength.impulse;
                EXPECT_NEAR(told, due, 0.02 * blow) << int(kind) << " " << e << " step " << i;
                before = now, total += told;
            }
            EXPECT_GT(total, 0.9 * blow) << int(kind) << " " << e;
        }
}

// A blow between figures is over in a step, whatever its speed.
TYPED_TEST(ContactEvents, ImpulsesOfFiguresAreTheChangeOfMomentum) {
    for (const double speed : {0.5, 4.0, 50.0}) {
        Blow<TypeParam> blow;
        blow.world.contacts.lists_figures = true;
        set_velocity(blow.world, blow.particle(blow.one), at<typename TypeParam::Vector>(speed, 0));
        double before = 0;
        for (int i = 0; i < 120; ++i) {
            step(blow.world, typename TypeParam::Real(1.0 / 60));
            const double now = double((*velocity_of(blow.world, blow.particle(blow.two)))[0]);
            double told = 0;
            for (const auto& touch : blow.world.contacts.figures) told += touch.strength.impulse;
            EXPECT_NEAR(told, now - before, 0.02 * speed) << speed << " step " << i;
            before = now;
        }
        EXPECT_NEAR(before, speed / 2, 0.01 * speed);
    }
}

/// Steps in which the touch of a rod with a small sphere between its ends begins and has ended.
template <class Type> std::vector<EventType> pass_a_rod(bool is_sensor) {
    using Real = typename Type::Real;
    using Vector = typename Type::Vector;
    typename Type::World world;
    add_collider(world, collide::Collider<Type::dimension, Real>{
                            .shape = collide::Sphere<Type::dimension, Real>{Real(0.05)}, .is_sensor = is_sensor});
    const auto figure = add_figure(world, "rod");
    set_contact(world, figure, {.figures = true});
    std::vector<ParticleId> ids;
    for (const double x : {-0.5, 0.5})
        ids.push_back(add_particle(
            world,
            {.position = at<Vector>(x, 0.5), .velocity = at<Vector>(0, -2), .radius = Real(0.02), .figure = figure}));
    add<Distance>(world, {ids[0], ids[1]}, {.figure = figure});
    world.figures[figure].particles = ids;
    Piece stroke{.mark = Mark::stroke};
    for (const auto id : ids) stroke.particles.push_back(id);
    world.figures[figure].pieces.push_back(stroke);
    std::vector<EventType> told;
    for (int i = 0; i < 60; ++i) {
        step(world, Real(1.0 / 60));
        for (const auto& event : world.events) told.push_back(event.type);
    }
    EXPECT_EQ(double((*position_of(world, ids[0]))[1]) < -1, is_sensor) << "pushed by solids only";
    return told;
}
TYPED_TEST(ContactEvents, ASensorNoticesLinksAsASolidDoes) {
    EXPECT_EQ(pass_a_rod<TypeParam>(true), (std::vector{EventType::touched, EventType::parted}));
    ASSERT_FALSE(pass_a_rod<TypeParam>(false).empty());
    EXPECT_EQ(pass_a_rod<TypeParam>(false)[0], EventType::touched);
}

// A ball on a floor within the zone of a sensor touches both.
TYPED_TEST(ContactEvents, AParticleTouchesSeveralColliders) {
    using Real = typename TypeParam::Real;
    using World = typename TypeParam::World;
    using Vector = typename TypeParam::Vector;
    World world;
    fall(world, 10);
    add_collider(world, collide::Collider<World::dimension, Real>{
                            .shape = collide::HalfSpace<World::dimension, Real>{.normal = at<Vector>(0, 1)}});
    const auto zone = add_collider(
        world, collide::Collider<World::dimension, Real>{.shape = collide::Sphere<World::dimension, Real>{Real(0.5)},
                                                         .target = {.position = at<Vector>(2, 0)},
                                                         .is_sensor = true});
    add_particle(world, {.position = at<Vector>(0, 0.1), .velocity = at<Vector>(2, 0), .radius = Real(0.1)});
    int began = 0, ended = 0;
    for (int i = 0; i < 120; ++i) {
        step(world, Real(1.0 / 60));
        for (const auto& event : world.events)
            if (event.collider == zone) (event.type == EventType::touched ? began : ended)++;
    }
    EXPECT_EQ(began, 1);
    EXPECT_EQ(ended, 1);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#include "sinew/world/edit.h"

#include "tests/crates.h"

#include <functional>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Real> struct Sleepers : ::testing::Test {
    FlatWorld<Real> world;
    std::vector<std::vector<ParticleId>> crates;

    /// Stacks of crates, 5 m apart, on the ground.
    void build(int stacks, int height) {
        add_ground(world);
        world.settings.sleep = {Real(0.05), Real(0.5)};
        for (int n = 0; n < stacks; ++n)
            for (int i = 0; i < height; ++i) crates.push_back(add_crate(world, 5 * n, 0.5 + i, 1, 1));
    }
    bool is_asleep(std::size_t crate) const {
        std::size_t count = 0;
        for (const auto id : crates[crate]) count += world.particles.asleep[*world.particles.handles.find(id)] != 0;
        EXPECT_TRUE(count == 0 || count == crates[crate].size()) << "a body sleeps as a whole";
        return count > 0;
    }
    std::size_t sleepers() const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < crates.size(); ++i) count += is_asleep(i);
        return count;
    }
    void one_step() { step(world, Real(1.0 / 60)); }
};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Sleepers, Precisions);

TYPED_TEST(Sleepers, AStackAtRestFallsAsleepAndIsLeftOutOfTheStep) {
    this->build(2, 3);
    run(this->world, 3);
    ASSERT_EQ(this->sleepers(), 6U);
    const auto before = this->world.particles.position;
    run(this->world, 1);
    EXPECT_EQ(this->world.particles.position, before);
    EXPECT_EQ(this->world.solver.sweep_state.size(), 0U);
    EXPECT_TRUE(this->world.solver.blocks.list.empty());
    EXPECT_EQ(mean_speed(this->world), 0);
}

TYPED_TEST(Sleepers, NothingFallsAsleepUnlessAsked) {
    this->build(1, 2);
    this->world.settings.sleep = {};
    run(this->world, 3);
    EXPECT_EQ(this->sleepers(), 0U);
}

TYPED_TEST(Sleepers, OnlyTheIslandThatIsTouchedWakes) {
    using Real = TypeParam;
    this->build(2, 3);
    run(this->world, 3);
    ASSERT_EQ(this->sleepers(), 6U);
    const auto figure = add_touching(this->world, 0.5);
    const auto ball =
        add_particle(this->world, {.position = {{0, 6}}, .mass = 1, .radius = Real(0.2), .figure = figure});
    run(this->world, 1.1); // an edit wakes all: 0.5 s later all sleep but the ball, which arrives after 0.75 s
    EXPECT_FALSE(this->is_asleep(0));
    EXPECT_FALSE(this->is_asleep(2));
    EXPECT_TRUE(this->is_asleep(3));
    EXPECT_GT(double((*position_of(this->world, ball))[1]), 3.19);
    run(this->world, 3);
    EXPECT_EQ(this->sleepers(), 6U);
    EXPECT_NEAR(double((*position_of(this->world, ball))[1]), 3.2, 0.01);
}

// The forces of contacts are kept in sleep: a stack that wakes stays as it is.
TYPED_TEST(Sleepers, AStackThatWakesDoesNotSink) {
    using Real = TypeParam;
    this->build(1, 10);
    this->world.settings.sleep.speed = Real(1e-3); // asleep only once the load is carried
    run(this->world, 8);
    ASSERT_EQ(this->sleepers(), 10U);
    const auto before = this->world.particles.position;
    set_velocity(this->world, this->crates[9][0], {{Real(1e-3), 0}});
    double fastest = 0;
    for (int i = 0; i < 20; ++i) {
        this->one_step();
        EXPECT_EQ(this->sleepers(), 0U);
        fastest = std::max(fastest, mean_speed(this->world));
    }
    EXPECT_LT(fastest, 1e-3);
    for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_LT(double(norm(this->world.particles.position[i] - before[i])), 1e-3);
}

template <class Real> struct Disturbance {
    const char* name;
    std::function<void(Sleepers<Real>&)> act;
};

template <class Real> std::vector<Disturbance<Real>> disturbances() {
    using S = Sleepers<Real>;
    return {
        {"ground removed", [](S& s) { s.world.bounds.clear(); }},
        {"gravity", [](S& s) { s.world.forces.clear(); }},
        {"friction", [](S& s) { s.world.bounds[0].friction = 0; }},
        {"mass", [](S& s) { set_mass(s.world, s.crates[0][0], Real(2)); }},
        {"substeps", [](S& s) { s.world.settings.substeps = 8; }},
        {"a link", [](S& s) { std::get<0>(s.world.constraints).compliance.set(0, Real(1e-6)); }},
        {"impulse",
         [](S& s) {
             apply_impulse(s.world, s.crates[0][0], {{1, 0}});
         }},
        {"force",
         [](S& s) {
             apply_force(s.world, s.crates[0][0], {{1, 0}});
         }},
        {"place",
         [](S& s) {
             set_position(s.world, s.crates[0][0], {{0, 1}});
         }},
        {"crate removed",
         [](S& s) {
             remove_particles(s.world, s.crates.front());
             s.crates.erase(s.crates.begin());
         }},
        {"pin", [](S& s) { pin(s.world, s.crates[0][0]); }},
        {"sleep off", [](S& s) { s.world.settings.sleep = {}; }},
        {"classic", [](S& s) { s.world.settings.mode = Mode::classic; }},
    };
}

TYPED_TEST(Sleepers, EveryEditWakes) {
    for (const auto& disturbance : disturbances<TypeParam>()) {
        struct Case : Sleepers<TypeParam> {
            void TestBody() override {}
        } scene;
        scene.build(1, 3);
        run(scene.world, 3);
        ASSERT_EQ(scene.sleepers(), 3U) << disturbance.name;
        disturbance.act(scene);
        scene.one_step();
        EXPECT_EQ(scene.sleepers(), 0U) << disturbance.name;
    }
}

TYPED_TEST(Sleepers, AMovedPinAndAMovedColliderWake) {
    using Real = TypeParam;
    this->build(2, 2);
    const auto table =
        add_collider(this->world, {.shape = collide::Box<2, Real>{{{1, 1}}}, .target = {{{Real(1.05), Real(0.5)}}}});
    const auto held = pin(this->world, this->crates[2][0], {.compliance = Real(1e-3)});
    run(this->world, 3);
    ASSERT_EQ(this->sleepers(), 4U);
    move_collider(this->world, table, {{{Real(1.02), Real(0.5)}}});
    this->one_step();
    EXPECT_FALSE(this->is_asleep(0));
    EXPECT_TRUE(this->is_asleep(2));
    run(this->world, 3);
    ASSERT_EQ(this->sleepers(), 4U);
    move_pin(this->world, *held, {{5, 1}});
    this->one_step();
    EXPECT_TRUE(this->is_asleep(0));
    EXPECT_FALSE(this->is_asleep(2));
}

// Nothing near enough to be hit within the step sleeps on, however fast it is hit.
TYPED_TEST(Sleepers, ABulletDoesNotCrossASleeper) {
    using Real = TypeParam;
    this->build(2, 1);
    const auto figure = add_touching(this->world, 0.5);
    const auto bullet = add_particle(
        this->world, {.position = {{-40, 0.5}}, .mass = Real(0.01), .radius = Real(0.05), .figure = figure});
    pin(this->world, bullet);
    run(this->world, 3);
    ASSERT_EQ(this->sleepers(), 2U);
    unpin_all(this->world, bullet);
    run(this->world, 1);
    set_velocity(this->world, bullet, {{1000, Real(0.5)}});
    run(this->world, 0.1);
    EXPECT_LT(double((*position_of(this->world, bullet))[0]),
              double((*position_of(this->world, this->crates[0][0]))[0]));
}

TYPED_TEST(Sleepers, RunsRepeatToTheBit) {
    using Real = TypeParam;
    this->build(3, 3);
    const auto figure = add_touching(this->world, 0.5);
    add_particle(this->world, {.position = {{Real(0.1), 16}}, .mass = 1, .radius = Real(0.2), .figure = figure});
    bool any = false;
    for (int i = 0; i < 300; ++i) {
        any = any || this->sleepers() > 0;
        FlatWorld<Real> copy = this->world;
        copy.solver.options.threads = 3;
        this->one_step();
        step(copy, Real(1.0 / 60));
        ASSERT_EQ(state_hash(copy), state_hash(this->world)) << i;
    }
    EXPECT_TRUE(any);
}

// A crate that sleeps on a sensor touches it all the time: one touch is reported, and none of its end.
TYPED_TEST(Sleepers, TouchesGoOnInSleep) {
    using Real = TypeParam;
    this->build(1, 1);
    add_collider(this->world, {.shape = collide::Box<2, Real>{{{2, Real(0.6)}}}, .is_sensor = true});
    std::size_t events = 0;
    for (int i = 0; i < 300; ++i) {
        this->one_step();
        events += this->world.events.size();
    }
    EXPECT_EQ(this->sleepers(), 1U);
    EXPECT_EQ(events, 2U); // its two lower corners
}

// A hanging rope is a block, solved directly: at rest it sleeps, and wakes when its pin is moved.
TYPED_TEST(Sleepers, ABlockSleepsToo) {
    using Real = TypeParam;
    fall(this->world, 10);
    this->world.settings.sleep = {Real(0.05), Real(0.5)};
    std::vector<ParticleId> rope;
    for (int i = 0; i < 10; ++i)
        rope.push_back(add_particle(this->world, {.position = {{0, Real(-0.1 * i)}}, .mass = Real(0.1)}));
    for (std::size_t i = 1; i < rope.size(); ++i) add<Distance>(this->world, {rope[i - 1], rope[i]});
    const auto held = pin(this->world, rope[0]);
    this->one_step();
    EXPECT_EQ(this->world.solver.blocks.list.size(), 1U);
    run(this->world, 2);
    EXPECT_TRUE(this->world.solver.blocks.list.empty());
    move_pin(this->world, *held, {{1, 0}});
    run(this->world, 0.2);
    EXPECT_EQ(this->world.solver.blocks.list.size(), 1U);
    EXPECT_GT(double((*position_of(this->world, rope[1]))[0]), 0.5);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

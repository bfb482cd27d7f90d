#include "sinew/prefab/prefabs.h"
#include "sinew/world/measure.h"

#include "tests/sanitized.h"
#include "tests/stepped.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <cmath>
#include <rapidcheck.h>

/// What is solved at once: ropes and trees that do not stretch and do not gain.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Real> test::Stepped<2, Real> rope_world(int links, double weight, double angle, bool exact = false) {
    test::Stepped<2, Real> world;
    fall(world, gravity);
    build(world,
          Rope{.length = 10,
               .segments = links,
               .angle = angle,
               .mass = double(links),
               .weight = weight,
               .links = exact ? "exact" : "at_most"},
          "rope");
    return world;
}

struct Extremes {
    double stretch = 0, gain = 0, loss = 0; ///< of energy: as a part of all weight times the length
};

template <class World> Extremes extremes(World& world, double seconds, double scale) {
    using Real = typename World::Real;
    const double begun = energy(world).total();
    Extremes max;
    for (int i = 0; i < int(seconds * 60); ++i) {
        step(world, Real(1.0 / 60));
        const double change = (energy(world).total() - begun) / scale;
        max.stretch = std::max(max.stretch, stretch(world).max);
        max.gain = std::max(max.gain, change);
        max.loss = std::max(max.loss, -change);
    }
    return max;
}

template <class Real> void expect_no_stretch(double bound) {
    for (const int links : {10, 100})
        for (const double weight : {1.0, 100.0, 1000.0, 100000.0})
            for (const double angle : {0.0, pi<double> / 2, 2.5}) {
                auto world = rope_world<Real>(links, weight, angle);
                const auto max = extremes(world, sanitized ? 0.07 : 1.5, (links + weight) * gravity * 10);
                EXPECT_LT(max.stretch, bound) << links << " links, weight " << weight << ", from " << angle;
                EXPECT_LT(max.gain, 1e-4) << links << " links, weight " << weight << ", from " << angle;
            }
}

TEST(Block, RopesDoNotStretchWhateverHangsOnThem) {
    expect_no_stretch<double>(1e-4); // measured 5e-6
    expect_no_stretch<float>(1e-3);  // measured 1e-4: a link of 10 cm ten metres out, in steps of a micrometre
}

// Released from 0.9 rad, undamped: half a minute, at the default settings.
TEST(Block, ASwingKeepsItsEnergy) {
    for (const int links : {2, 3, 20})
        for (const double weight : {0.0, 100.0}) {
            auto world = rope_world<double>(links, weight, 0.9, true);
            const auto max = extremes(world, sanitized ? 2 : 30, (links + weight) * gravity * 10);
            EXPECT_LT(max.gain, 1e-6) << links;
            EXPECT_LT(max.loss, 1e-6) << links;
        }
}

// Ten minutes in which its end cracks again and again.
TEST(Block, AWhipKeepsItsEnergyToo) {
    constexpr int links = 20;
    auto world = rope_world<double>(links, 0, 0.9, true);
    const auto max = extremes(world, sanitized ? 2 : 600, links * gravity * 10);
    EXPECT_LT(max.gain, 1e-4); // measured 4e-6
    EXPECT_LT(max.loss, 1e-4);
}

// A rope with room between its links is dropped, snaps taut and is drawn along: what it has and what it gave up is what
// it had.
TEST(Block, WhatARopeGivesUpIsCounted) {
    constexpr int links = 20;
    auto world = rope_world<double>(links, 5, 2.5);
    constexpr double scale = (links + 5) * gravity * 10;
    const double begun = energy(world).total();
    for (int i = 0; i < (sanitized ? 60 : 600); ++i) {
        step(world, 1.0 / 60);
        const auto now = energy(world);
        EXPECT_NEAR((now.total() + now.lost - begun) / scale, 0, 1e-4) << i;
    }
    EXPECT_GT(energy(world).lost / scale, sanitized ? 0 : 0.01);
    auto copy = world;
    EXPECT_EQ(energy(copy).lost, energy(world).lost);
}

TEST(Block, ASwingGivesUpNothing) {
    auto world = rope_world<double>(20, 0, 0.9, true);
    extremes(world, 2, 1);
    EXPECT_NEAR(energy(world).lost / (20 * gravity * 10), 0, 1e-6);
}

// The tension of each link of a rope at rest is the weight below it.
TEST(Block, TensionIsTheWeightBelow) {
    constexpr int links = 50;
    constexpr double weight = 7;
    auto world = rope_world<double>(links, weight, 0);
    run(world, 1);
    const auto& figure = world.figures[0];
    for (int i = 0; i < links; ++i) {
        // a rope of equal masses but at its ends, which have half
        const double below = (links - i - 0.5 + weight) * gravity;
        const auto id = figure.constraints[std::size_t(i)];
        ASSERT_EQ(id.kind, (kind_number<Distance, 2>));
        EXPECT_NEAR(constraint_state(world, id)->tension / below, 1, 1e-3) << i;
    }
}

TEST(Block, DampingIsWhatItsExponentialSays) {
    test::Stepped<2, double> world;
    const auto ids = chain(world, 3, {{0, 0}}, {{1, 0}});
    for (const auto id : ids) set_velocity(world, id, {{3, 1}});
    world.settings.damping = 0.5;
    run(world, 2);
    for (const auto id : ids) EXPECT_NEAR((*velocity_of(world, id))[0], 3 * std::exp(-1.0), 1e-9);
}

// A small swing is  x = e^(-damping t / 2) (a cos w t + b sin w t),  w^2 = g / length - damping^2 / 4,  so that
// x^2 + (x' + x damping / 2)^2 / w^2  falls as e^(-damping t) whatever its phase.
TEST(Block, ADampedSwingDiesAwayAsItsExponentialSays) {
    constexpr double angle = 0.02;
    for (const double damping : {0.02, 0.1, 0.5, 2.0}) {
        test::Stepped<2, double> world;
        fall(world, gravity);
        world.settings.damping = damping;
        const auto ids = chain(world, 2, {{0, 0}}, {{std::sin(angle), -std::cos(angle)}});
        pin(world, ids[0]);
        world.figures[add_figure(world, "figure")].direct = Direct::on;
        for (auto& figure : world.particles.figure) figure = 0;
        const double w2 = gravity - square(damping / 2);
        double begun = 0;
        for (int i = 0; i <= 600; ++i) {
            const double x = (*position_of(world, ids[1]))[0], rate = (*velocity_of(world, ids[1]))[0];
            const double now = square_root(x * x + square(rate + x * damping / 2) / w2);
            if (i == 0) begun = now;
            ASSERT_NEAR(now / begun / std::exp(-damping * i / 120), 1, 0.01) << damping << " after " << i / 60.0;
            step(world, 1.0 / 60);
        }
    }
}

/// Two equal masses on two equal rods, from the Lagrangian, by Runge and Kutta's method with small steps.
struct DoublePendulum {
    std::array<double, 4> state; ///< angles from below, and their rates
    static constexpr double length = 1;

    static std::array<double, 4> slope(const std::array<double, 4>& s) {
        const double d = s[0] - s[1], g = gravity, l = length;
        const double common = 3 - std::cos(2 * d);
        const double a = (-3 * g * std::sin(s[0]) - g * std::sin(s[0] - 2 * s[1]) -
                          2 * std::sin(d) * (s[3] * s[3] * l + s[2] * s[2] * l * std::cos(d))) /
                         (l * common);
        const double b = 2 * std::sin(d) *
                         (2 * s[2] * s[2] * l + 2 * g * std::cos(s[0]) + s[3] * s[3] * l * std::cos(d)) / (l * common);
        return {s[2], s[3], a, b};
    }
    static std::array<double, 4> ahead(const std::array<double, 4>& s, const std::array<double, 4>& by, double h) {
        return {s[0] + h * by[0], s[1] + h * by[1], s[2] + h * by[2], s[3] + h * by[3]};
    }
    void run(double seconds) {
        constexpr double h = 1e-4;
        for (int i = 0; i < int(seconds / h + 0.5); ++i) {
            const auto a = slope(state), b = slope(ahead(state, a, h / 2)), c = slope(ahead(state, b, h / 2)),
                       d = slope(ahead(state, c, h));
            for (std::size_t k = 0; k < 4; ++k) state[k] += h / 6 * (a[k] + 2 * b[k] + 2 * c[k] + d[k]);
        }
    }
    Vec2<double> end() const {
        return {
            {length * (std::sin(state[0]) + std::sin(state[1])), -length * (std::cos(state[0]) + std::cos(state[1]))}};
    }
};

double double_pendulum_error(int substeps) {
    test::Stepped<2, double> world;
    world.settings.substeps = substeps;
    fall(world, gravity);
    const double angle = 0.9;
    const auto ids = chain(world, 3, {{0, 0}}, {{std::sin(angle), -std::cos(angle)}});
    pin(world, ids[0]);
    DoublePendulum exact{{angle, angle, 0, 0}};
    exact.run(2);
    run(world, 2);
    return distance(*position_of(world, ids[2]), exact.end()) / 2;
}

TEST(Block, ADoublePendulumGoesTheWayTheEquationsSay) {
    const double four = double_pendulum_error(4), eight = double_pendulum_error(8), sixteen = double_pendulum_error(16);
    EXPECT_LT(four, 0.01);
    EXPECT_NEAR(four / eight, 4, 0.5) << "second order";
    EXPECT_NEAR(eight / sixteen, 4, 0.5);
}

// An edit elsewhere makes the blocks anew. Nothing of what was there moves otherwise for that, nor in a copy.
TEST(Block, WhatIsMadeAnewGoesOnInTheSameBits) {
    for (const double damping : {0.0, 0.3}) {
        test::Stepped<2, double> world;
        fall(world, gravity);
        world.settings.damping = damping;
        world.bounds.push_back({.normal = {{0, 1}}, .offset = -1.5, .friction = 0.5});
        build(world, Rope{.length = 2, .segments = 12, .angle = 2.5, .mass = 1}, "rope");
        build(world, Ragdoll{}, "bob", {.at = {{4, 0}}});
        pin(world, *find_particle(world, "bob/left_hand"));
        const auto bystander = add_particle(world, {.position = {{-5, 0}}});
        for (int i = 0; i < 120; ++i) {
            auto copy = world, edited = world;
            unpin(edited, *pin(edited, bystander));
            step(world, 1.0 / 60);
            step(copy, 1.0 / 60);
            step(edited, 1.0 / 60);
            ASSERT_EQ(state_hash(copy), state_hash(world)) << damping << ", step " << i;
            ASSERT_EQ(edited.particles.position, world.particles.position) << damping << ", step " << i;
            ASSERT_EQ(edited.particles.velocity, world.particles.velocity) << damping << ", step " << i;
        }
    }
}

// Forty loaded ropes on one ball: it goes last, when all that hangs on it has gone.
TEST(Block, AHubThatManyHangOnIsSolvedAtOnce) {
    test::Stepped<2, double> world;
    fall(world, gravity);
    const auto nail = add_particle(world, {.position = at<Vec2<double>>(0, 1)});
    const auto hub = add_particle(world, {.mass = 0.01});
    pin(world, nail);
    add<Distance>(world, {nail, hub}, {.limits = exactly(1.0)});
    for (int i = 0; i < 40; ++i) {
        const double angle = pi<double> * (i + 0.5) / 40;
        const auto weight = add_particle(
            world, {.position = at<Vec2<double>>(2 * std::cos(angle), -2 * std::sin(angle)), .mass = 1000});
        add<Distance>(world, {hub, weight}, {.limits = at_most(2.0)});
    }
    const auto max = extremes(world, sanitized ? 0.3 : 3, 40000 * gravity * 3);
    EXPECT_LT(max.stretch, 1e-4);
    EXPECT_LT(max.gain, 1e-4);
}

// A figure that swings, falls apart into two and goes on.
TEST(Block, LettingGoAddsNoEnergy) {
    for (int at = 5; at < 120; at += 13) {
        auto world = rope_world<double>(20, 5, pi<double> / 2);
        run(world, at / 60.0);
        const double before = energy(world).total();
        unpin_all(world, *find_particle(world, "rope/start"));
        step(world, 1.0 / 60);
        EXPECT_LT(energy(world).total() - before, 1e-4 * 25 * gravity * 10) << at;
    }
}

// Springs between links that can go slack: a heap of them folds flat in any way, and still falls and comes to rest.
TEST(Block, AHeapOfSlackSpringsComesToRest) {
    for (const double stiffness : {0.01, 0.1, 1.0}) {
        test::Stepped<2, double> world;
        fall(world, gravity);
        world.bounds.push_back({{{0, 1}}, 0, 0, 0.4});
        const int segments = sanitized ? 10 : 20;
        build(world, Rope{.length = 2, .segments = segments, .angle = pi<double> * 0.97, .pinned = "none", .mass = 1},
              "rope", {.at = {{0, 0.2}}});
        const auto ids = world.figures[0].particles;
        const double compliance = 2.0 / segments / stiffness;
        for (std::size_t i = 2; i < ids.size(); ++i)
            add<Angle>(world, {ids[i - 2], ids[i - 1], ids[i]}, {.limits = exactly(0.0), .compliance = compliance});
        run(world, sanitized ? 1 : 2);
        double highest = 0, fastest = 0;
        for (const auto& position : world.particles.position) highest = max(highest, position[1]);
        for (const auto& velocity : world.particles.velocity) fastest = max(fastest, norm(velocity));
        EXPECT_LT(highest, 0.5) << "it stood two metres high; stiffness " << stiffness;
        EXPECT_LT(fastest, 0.5);
        EXPECT_LT(stretch(world).max, 1e-3);
    }
}

// Of six rods between four corners one is too many: what they hold against each other must not grow.
TEST(Block, BracesDoNotPullAgainstEachOther) {
    test::Stepped<3, float> world;
    fall(world, gravity);
    std::vector<ParticleId> corners;
    for (const Vec<3, float> position : {Vec<3, float>{{0, 0, 0}}, {{0.4F, 0, 0}}, {{0.4F, 0.2F, 0}}, {{0, 0.2F, 0}}})
        corners.push_back(
            add_particle(world, {.position = position, .velocity = {{position[1], -position[0], position[0]}}}));
    for (std::size_t i = 0; i < corners.size(); ++i)
        for (std::size_t j = i + 1; j < corners.size(); ++j) add<Distance>(world, {corners[i], corners[j]});
    run(world, 2);
    const auto& rods = std::get<kind_number<Distance, 3>>(world.constraints);
    for (Row row = 0; row < rods.size(); ++row) {
        const auto state = constraint_state(world, {kind_number<Distance, 3>, rods.handles.id_of(row)});
        EXPECT_LT(std::abs(state->tension), 1000) << "each corner weighs ten newtons";
        EXPECT_LT(std::abs(state->strain), 1e-5);
    }
}

TEST(Block, PinnedFurtherApartThanItIsLongItStretchesEvenlyAndComesBack) {
    test::Stepped<2, double> world;
    fall(world, gravity);
    const auto ids = chain(world, 11, {{0, 0}}, {{0.5, 0}});
    pin(world, ids.front());
    const auto far = *pin(world, ids.back());
    move_pin(world, far, {{7.5, 0}});
    run(world, 1);
    for (std::size_t i = 0; i + 1 < ids.size(); ++i)
        EXPECT_NEAR(distance(*position_of(world, ids[i]), *position_of(world, ids[i + 1])), 0.75, 0.02) << i;
    for (int i = 1; i <= 60; ++i) {
        move_pin(world, far, {{7.5 - 3.5 * i / 60, 0}});
        step(world, 1.0 / 60);
    }
    run(world, 2);
    EXPECT_LT(stretch(world).max, 1e-5);
    EXPECT_LT(max_speed(world), 15);
}

// --- any tree
// ----------------------------------------------------------------------------------------------------------

/// A tree of links of any loads in any pose: straight, folded up, in a heap, squeezed.
template <int D> test::Stepped<D, double> any_tree(double& scale) {
    using Vector = Vec<D, double>;
    test::Stepped<D, double> world;
    fall(world, gravity);
    const int count = *rc::gen::inRange(3, 40), pose = *rc::gen::inRange(0, 4);
    const bool loops = *rc::gen::arbitrary<bool>();
    std::vector<ParticleId> ids;
    std::vector<Vector> positions;
    double mass = 0;
    for (int i = 0; i < count; ++i) {
        const double own = std::pow(10, *rc::gen::inRange(-2, 4));
        const auto parent = std::size_t(i == 0 ? 0 : *rc::gen::inRange(std::max(0, i - 4), i));
        Vector position{};
        if (i > 0) {
            Vector way{};
            for (int axis = 0; axis < D; ++axis) way[axis] = *rc::gen::inRange(-100, 101) / 100.0;
            if (pose == 0) way = at<Vector>(0, -1);
            if (pose == 1) way = at<Vector>(i % 2 ? 0.5 : -0.5, 0);
            position = positions[parent] + (norm(way) > 0.01 ? direction(way) : at<Vector>(1, 0)) * 0.5;
        }
        positions.push_back(position);
        ids.push_back(add_particle(world, {.position = pose == 3 ? position * 0.3 : position, .mass = own}));
        mass += own;
        if (i == 0) continue;
        const bool rope = *rc::gen::arbitrary<bool>();
        add<Distance>(world, {ids[parent], ids.back()}, {.limits = rope ? at_most(0.5) : exactly(0.5)});
    }
    if (loops && count > 6) // its own length: it can always be met
        add<Distance>(world, {ids[1], ids[std::size_t(count) - 1]},
                      {.limits = at_most(distance(positions[1], positions[std::size_t(count) - 1]) + 0.1)});
    pin(world, ids[0]);
    scale = mass * gravity * 0.5 * count;
    return world;
}

template <int D> void expect_trees_stand() {
    const int hundreds = few_or_many(1, 50);
    for (int i = 0; i < hundreds; ++i) {
        ASSERT_TRUE(rc::check([&] {
            double scale = 0;
            auto world = any_tree<D>(scale);
            const double dt = *rc::gen::element(1e-3, 1.0 / 240, 1.0 / 60, 1.0 / 60, 1.0 / 20, 0.1);
            const int frames = sanitized ? 12 : std::min(int(2 / dt), 200);
            step(world, dt); // what was squeezed or stretched has come to its lengths
            const double begun = energy(world).total();
            for (int frame = 0; frame < frames; ++frame) {
                step(world, dt);
                RC_ASSERT(energy(world).total() - begun < 1e-2 * scale);
            }
            for (const auto& position : world.particles.position) RC_ASSERT(is_finite(position));
            RC_ASSERT(stretch(world).max < 1e-3);
        })) << i;
    }
}

TEST(Block, AnyTreeStandsAnyPose2D) {
    expect_trees_stand<2>();
}
TEST(Block, AnyTreeStandsAnyPose3D) {
    expect_trees_stand<3>();
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

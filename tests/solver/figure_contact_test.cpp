#include "sinew/solver/simd/kernel.h"
#include "sinew/world/colliders.h"

#include "bench/contact.h"
#include "tests/crates.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>

namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class RealT> struct Figures2 : ::testing::Test {};
using Precisions = ::testing::Types<float, double>;

TYPED_TEST_SUITE(Figures2, Precisions);

TYPED_TEST(Figures2, AStackOfTenRests) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    add_ground(world);
    std::vector<std::vector<ParticleId>> crates;
    for (int i = 0; i < 10; ++i) crates.push_back(add_crate(world, 0.01 * (i % 3), 0.5 + i, 1, 1));
    run(world, 10);
    EXPECT_LT(mean_speed(world), 1e-3);
    EXPECT_LT(stretch(world).max, 1e-3);
    for (int i = 0; i < 10; ++i) {
        const auto middle = middle_of(world, crates[std::size_t(i)]);
        EXPECT_NEAR(double(middle[1]), 0.5 + i, 0.02);
        EXPECT_NEAR(double(middle[0]), 0.01 * (i % 3), 0.01);
    }
}

TYPED_TEST(Figures2, APyramidOfFifteenRowsRests) {
    using Real = TypeParam;
    constexpr int rows = 15;
    FlatWorld<Real> world;
    add_ground(world);
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < rows - row; ++i) add_crate(world, 1.1 * (i + 0.5 * row), 0.5 + row, 1, 1);
    const auto before = world.particles.position;
    run(world, 10);
    EXPECT_LT(mean_speed(world), 1e-3);
    EXPECT_LT(stretch(world).max, 1e-3);
    for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_LT(double(norm(world.particles.position[i] - before[i])), 0.05) << i;
}

/// A rigid figure of six corners in two filled areas with a side between them, as a car's cabin and body.
template <class Real> std::vector<ParticleId> add_car(FlatWorld<Real>& world, const std::vector<V2<Real>>& corners) {
    const auto car = add_touching(world, 0.5);
    std::vector<ParticleId> p;
    for (const auto& corner : corners)
        p.push_back(add_particle(world, {.position = corner, .radius = Real(0.02), .figure = car}));
    for (std::size_t i = 0; i < p.size(); ++i)
        for (auto k = i + 1; k < p.size(); ++k) add<Distance>(world, {p[i], p[k]}, {.figure = car});
    world.figures[car].particles = p;
    world.figures[car].pieces.push_back({.mark = Mark::fill, .particles = {p[2], p[3], p[4], p[5]}});
    world.figures[car].pieces.push_back({.mark = Mark::fill, .particles = {p[0], p[1], p[2], p[5]}});
    return p;
}

// A figure above or below both areas is inside neither, however wide the widest particle of the world is.
TYPED_TEST(Figures2, NothingIsInsideAFigureOfTwoAreasThatStandsBesideIt) {
    for (const double x : {-0.4, 0.0, 0.4})
        for (const double y : {-0.045, 1.045}) {
            FlatWorld<TypeParam> world;
            add_car<TypeParam>(world, {{{TypeParam(-0.8), 0}},
                                       {{TypeParam(0.8), 0}},
                                       {{1, TypeParam(0.2)}},
                                       {{TypeParam(0.6), 1}},
                                       {{TypeParam(-0.6), 1}},
                                       {{-1, TypeParam(0.2)}}});
            const auto stick = add_touching(world, 0.5), wide = add_touching(world, 0.5);
            const auto end = [&](double dx) {
                return add_particle(
                    world,
                    {.position = {{TypeParam(x + dx), TypeParam(y)}}, .radius = TypeParam(0.02), .figure = stick});
            };
            const auto a = end(-0.1), b = end(0.1);
            add<Distance>(world, {a, b}, {.figure = stick});
            world.figures[stick].particles = {a, b};
            const auto ball = add_particle(world, {.position = {{9, 0}}, .radius = TypeParam(2), .figure = wide});
            world.figures[wide].particles = {ball};
            run(world, 0.5);
            EXPECT_EQ(mean_speed(world), 0) << x << ", " << y;
        }
}

// The edge between two areas is no wall: a weight falls onto the roof and rests there, and one that begins within
// leaves by an outer side.
TYPED_TEST(Figures2, AWeightRestsOnAFigureOfTwoAreas) {
    FlatWorld<TypeParam> world;
    world.settings.substeps = 16;
    add_ground(world);
    const auto low = TypeParam(0.02), middle = TypeParam(0.5);
    const auto p =
        add_car<TypeParam>(world, {{{-1, low}}, {{1, low}}, {{1, middle}}, {{1, 1}}, {{-1, 1}}, {{-1, middle}}});
    const auto crate = add_crate(world, 0, 2, 0.5, 1), inside = add_crate(world, 1.1, 0.25, 0.5, 1);
    run(world, 6);
    EXPECT_NEAR(double(middle_of(world, crate)[1]), 1.02 + 0.25, 0.02);
    EXPECT_NEAR(double(middle_of(world, inside)[1]), 0.25, 0.02);
    EXPECT_GT(double(middle_of(world, inside)[0] - (*position_of(world, p[1]))[0]), 0.24);
    EXPECT_LT(mean_speed(world), 1e-3);
}

// Crates that begin inside each other part, the shortest way, no faster than one that falls as far, and rest side by
// side or on each other.
TYPED_TEST(Figures2, CratesThatBeginInsideEachOtherPart) {
    for (const double x : {0.46, 0.3, 0.1})
        for (const double y : {0.25, 0.3, 0.45}) {
            FlatWorld<TypeParam> world;
            world.settings.substeps = 16;
            add_ground(world);
            const auto one = add_crate(world, 0, 0.25, 0.5, 1), other = add_crate(world, x, y, 0.5, 1);
            double fastest = 0;
            for (int i = 0; i < 300; ++i) {
                step(world, TypeParam(1.0 / 60));
                fastest = std::max(fastest, double(max_speed(world)));
            }
            const double apart = double(norm(middle_of(world, one) - middle_of(world, other)));
            EXPECT_GT(apart, 0.49) << x << ", " << y;
            EXPECT_LT(apart, 0.75) << x << ", " << y;
            EXPECT_LT(fastest, 4.5) << x << ", " << y; // sqrt(2 10 1): twice their height
            EXPECT_LT(mean_speed(world), 1e-3) << x << ", " << y;
        }
}

// Five crates stand from a centimetre to a hundred metres, at the substeps of scenes.
TYPED_TEST(Figures2, AStackStandsAtAnySize) {
    for (const double size : {0.01, 1.0, 100.0}) {
        FlatWorld<TypeParam> world;
        world.settings.substeps = 16;
        add_ground(world);
        std::vector<std::vector<ParticleId>> crates;
        for (int i = 0; i < 5; ++i)
            crates.push_back(add_crate(world, 0, size * (0.5 + i), size, 1, 0, 0.5, 0.05 * size));
        run(world, few_or_many(4, 20));
        for (int i = 0; i < 5; ++i) {
            const auto middle = middle_of(world, crates[std::size_t(i)]);
            EXPECT_NEAR(double(middle[0]), 0, 0.01 * size) << size;
            EXPECT_NEAR(double(middle[1]), size * (0.5 + i), 0.05 * size) << size;
        }
        EXPECT_LT(mean_speed(world), 1e-3 * size) << size;
    }
}

// The floor under the light crate answers within the substep: the heavy one stays where it lands, and nothing gives
// way.
TYPED_TEST(Figures2, AHeavyCrateRestsOnALightOne) {
    for (const double ratio : {3.0, 10.0, 100.0, 1000.0})
        for (const double drop : {0.0, 0.5, 2.0}) {
            FlatWorld<TypeParam> world;
            world.settings.substeps = 8;
            add_ground(world);
            const auto light = add_crate(world, 0, 0.25, 0.5, 1);
            const auto heavy = add_crate(world, 0.02, 0.75 + drop, 0.5, ratio);
            run(world, 3);
            const auto name = testing::Message() << ratio << ", dropped by " << drop;
            EXPECT_NEAR(double(middle_of(world, light)[1]), 0.25, 1e-3) << name;
            EXPECT_NEAR(double(middle_of(world, heavy)[1]), 0.75, 1e-3) << name;
            EXPECT_NEAR(double(middle_of(world, heavy)[0]), 0.02, 5e-3) << name;
            EXPECT_LT(double(max_speed(world)), 0.01) << name;
        }
}

// Ten crates whose masses go up by turns, the heaviest on top.
TYPED_TEST(Figures2, AStackOfUnlikeMassesStands) {
    FlatWorld<TypeParam> world;
    world.settings.substeps = 16;
    add_ground(world);
    std::vector<std::vector<ParticleId>> crates;
    for (int i = 0; i < 10; ++i) {
        constexpr std::array masses{1.0, 10.0, 100.0, 3.0, 1.0};
        crates.push_back(add_crate(world, 0, 0.5 + i, 1, i == 9 ? 1000 : masses[std::size_t(i % 5)]));
    }
    run(world, 5);
    for (int i = 0; i < 10; ++i) {
        const auto middle = middle_of(world, crates[std::size_t(i)]);
        EXPECT_NEAR(double(middle[0]), 0, 0.01) << i;
        EXPECT_NEAR(double(middle[1]), 0.5 + i, 0.01) << i;
    }
    EXPECT_LT(mean_speed(world), 1e-3);
}

// A crate on a slope of angle a slides if and only if tan a > mu, and then with g (sin a - mu cos a).
TYPED_TEST(Figures2, ACrateSlidesIffItsSlopeIsSteeperThanFriction) {
    using Real = TypeParam;
    const double mu = 0.5, degree = pi<double> / 180;
    for (const double beyond : {-0.5, 0.5, 8.0}) {
        FlatWorld<Real> world;
        const double angle = std::atan(mu) + beyond * degree;
        add_ground(world, angle, mu);
        const auto crate = add_crate(world, -std::sin(angle) / 2, std::cos(angle) / 2, 1, 1, angle);
        run(world, 0.5);
        const auto begun = middle_of(world, crate);
        const double speed = double(norm(*velocity_of(world, crate[0])));
        run(world, 1);
        const double way = double(norm(middle_of(world, crate) - begun));
        const double expected = beyond < 0 ? 0 : speed + 10 * (std::sin(angle) - mu * std::cos(angle)) / 2;
        EXPECT_NEAR(way, expected, 0.02 * expected + 1e-4) << beyond;
    }
}

// Equal discs exchange nothing but momentum: without friction and rebound both go on at half the speed.
TYPED_TEST(Figures2, ABlowKeepsMomentumAndIsSharedByMass) {
    using Real = TypeParam;
    for (const double ratio : {1.0, 5.0, 100.0}) {
        FlatWorld<Real> world;
        const auto one = add_touching(world, 0), two = add_touching(world, 0);
        const auto striker = add_particle(
            world,
            {.position = {{-1, 0}}, .velocity = {{4, 0}}, .mass = Real(ratio), .radius = Real(0.2), .figure = one});
        const auto struck = add_particle(world, {.position = {{0, 0}}, .mass = 1, .radius = Real(0.2), .figure = two});
        run(world, 1);
        const double common = 4 * ratio / (ratio + 1);
        EXPECT_NEAR(double((*velocity_of(world, striker))[0]), common, 1e-3 * common);
        EXPECT_NEAR(double((*velocity_of(world, struck))[0]), common, 1e-3 * common);
        EXPECT_GT(double((*position_of(world, struck))[0] - (*position_of(world, striker))[0]), 0.399);
    }
}

/// A light rope over a round post, with a load at each end, `ratio` times as heavy on the right.
template <class Real> struct Capstan {
    FlatWorld<Real> world;
    std::vector<ParticleId> rope;

    /// `weight`: mass of the rope, of the left load. `links`: on the half circle.
    Capstan(double friction, double ratio, bool touches_figures, double weight = 0.2, double radius = 0.02,
            int links = 16) {
        constexpr double post = 1;
        const double around = post + radius;
        const double link = 2 * around * std::sin(pi<double> / links / 2);
        const int tail = int(2 / link);
        fall(world, 10);
        world.settings.damping = Real(0.5);
        add_collider(world, collide::Collider<2, Real>{.shape = collide::Sphere<2, Real>{Real(post)},
                                                       .friction = Real(friction)});
        const auto figure = add_touching(world, friction);
        if (!touches_figures) set_contact(world, figure, {});
        const double mass = weight / (links + 2 * tail + 1), hanging = mass * tail;
        for (int i = -tail; i <= links + tail; ++i) {
            const double angle = pi<double> * (1 - double(std::clamp(i, 0, links)) / links);
            const double below = i < 0 ? -i * link : std::max(0, i - links) * link;
            const double load = i == -tail ? 1 : i == links + tail ? ratio * (1 + hanging) - hanging : mass;
            rope.push_back(add_particle(
                world, {.position = {{Real(around * std::cos(angle)), Real(around * std::sin(angle) - below)}},
                        .mass = Real(load),
                        .radius = Real(radius),
                        .figure = figure}));
            if (rope.size() > 1)
                add<Distance>(world, {rope.end()[-2], rope.back()}, {.limits = at_most(Real(link)), .figure = figure});
        }
        Piece line{.mark = Mark::curve};
        for (const auto id : rope) line.particles.push_back(id), world.figures[figure].particles.push_back(id);
        world.figures[figure].pieces.push_back(line);
    }
    /// Way of the right load in two seconds, once the rope has settled.
    double slip() {
        run(world, 1);
        const auto height = [&] { return double((*position_of(world, rope.back()))[1]); };
        const double before = height();
        run(world, 2);
        return before - height();
    }
};

// A rope round a post holds a load exp(mu angle) times as heavy (Euler, Eytelwein), be it one that meets walls alone.
TYPED_TEST(Figures2, ARopeRoundAPostHoldsTheLoadOfEulerAndEytelwein) {
    for (const bool touches_figures : {true, false})
        for (const double friction : {0.15, 0.3, 0.5}) {
            const double law = std::exp(friction * pi<double>);
            EXPECT_NEAR(Capstan<TypeParam>(friction, 0.95 * law, touches_figures).slip(), 0, 2e-3) << friction;
            EXPECT_GT(Capstan<TypeParam>(friction, 1.05 * law, touches_figures).slip(), 0.2) << friction;
        }
}

// With particles 1300 and 6600 times lighter than the load it stays from the first instant on, and slips just above the
// law.
TYPED_TEST(Figures2, ALightRopeRoundAPostHoldsTheSameLoad) {
    constexpr double friction = 0.3, law = 2.566; // exp(mu pi)
    for (const double weight : {0.1, 0.02}) {
        Capstan<TypeParam> holds(friction, 0.93 * law, true, weight), slips(friction, 1.07 * law, true, weight);
        const double before = double((*position_of(holds.world, holds.rope.back()))[1]);
        run(holds.world, 1);
        EXPECT_NEAR(double((*position_of(holds.world, holds.rope.back()))[1]), before, 0.05) << weight;
        EXPECT_NEAR(holds.slip(), 0, 5e-3) << weight;
        EXPECT_GT(slips.slip(), 0.2) << weight;
    }
}

// The law is one for all weights and thicknesses of ropes: of 300 and 1000 times lighter particles a rope holds
// from the first instant on, and slips by the excess.
TYPED_TEST(Figures2, ARopeOfAnyWeightRoundAPostHoldsFromTheFirstInstant) {
    constexpr double friction = 0.3, law = 2.566; // exp(mu pi)
    for (const double radius : {0.02, 1e-5})
        for (const double weight : {0.3, 0.092}) {
            Capstan<TypeParam> holds(friction, 0.95 * law, true, weight, radius);
            Capstan<TypeParam> slips(friction, 1.05 * law, true, weight, radius);
            const double before = double((*position_of(holds.world, holds.rope.back()))[1]);
            EXPECT_NEAR(holds.slip(), 0, 2e-3) << weight << ' ' << radius;
            EXPECT_NEAR(double((*position_of(holds.world, holds.rope.back()))[1]), before, 0.01)
                << weight << ' ' << radius;
            const double way = slips.slip();
            EXPECT_GT(way, 0.2) << weight << ' ' << radius;
            EXPECT_LT(way, 1.2) << weight << ' ' << radius;
        }
}

TYPED_TEST(Figures2, ABulletDoesNotCrossACrate) {
    using Real = TypeParam;
    for (int i = 0; i < 20; ++i) {
        FlatWorld<Real> world;
        add_crate(world, 0, 0, 1, 1000);
        const auto figure = add_touching(world, 0.5);
        const auto bullet = add_particle(world, {.position = {{Real(-3 - 0.17 * i), Real(-0.4 + 0.04 * i)}},
                                                 .velocity = {{1000, 0}},
                                                 .mass = Real(0.01),
                                                 .radius = Real(0.02),
                                                 .figure = figure});
        run(world, 0.2);
        EXPECT_LT(double((*position_of(world, bullet))[0]), 0.5) << i;
    }
}

TYPED_TEST(Figures2, LooseDiscsFillABoxAndRest) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    add_ground(world);
    world.bounds.push_back({{{1, 0}}, -1, 0, Real(0.5)});
    world.bounds.push_back({{{-1, 0}}, -1, 0, Real(0.5)});
    const auto figure = add_touching(world, 0.5, true);
    constexpr int discs = 120;
    for (int i = 0; i < discs; ++i)
        add_particle(world,
                     {.position = {{Real(-0.85 + 0.21 * (i % 9) + 0.03 * (i / 9 % 2)), Real(0.2 + 0.22 * (i / 9))}},
                      .radius = Real(0.1),
                      .figure = figure});
    run(world, 10);
    EXPECT_LT(mean_speed(world), 1e-3);
    double overlap = 0;
    const auto& p = world.particles;
    for (Row a = 0; a < p.size(); ++a)
        for (Row b = a + 1; b < p.size(); ++b)
            overlap = std::max(overlap, 0.2 - double(distance(p.position[a], p.position[b])));
    EXPECT_LT(overlap, 0.01);
}

TYPED_TEST(Figures2, WhatDoesNotCollidePasses) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    const auto one = add_touching(world, 0), two = add_touching(world, 0);
    set_contact(world, two, {});
    const auto striker =
        add_particle(world, {.position = {{-1, 0}}, .velocity = {{4, 0}}, .radius = Real(0.2), .figure = one});
    add_particle(world, {.position = {{0, 0}}, .radius = Real(0.2), .figure = two});
    run(world, 1);
    EXPECT_NEAR(double((*position_of(world, striker))[0]), 3, 1e-5);
}

// A rope lies across a crate's corner: its links, not only its particles, stay outside.
TYPED_TEST(Figures2, ARopeOverACrateDoesNotPassThroughItsCorners) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    world.settings.damping = Real(0.5);
    add_ground(world);
    const auto crate = add_crate(world, 0, 0.5, 1, 50);
    const auto figure = add_touching(world, 0.5);
    std::vector<ParticleId> rope;
    for (int i = 0; i <= 8; ++i) {
        rope.push_back(add_particle(world, {.position = {{Real(-1 + 0.25 * i), Real(1.3)}},
                                            .mass = Real(0.1),
                                            .radius = Real(0.03),
                                            .figure = figure}));
        world.figures[figure].particles.push_back(rope.back());
        if (i > 0) add<Distance>(world, {rope[std::size_t(i) - 1], rope[std::size_t(i)]}, {.figure = figure});
    }
    Piece line{.mark = Mark::stroke};
    for (const auto id : rope) line.particles.push_back(id);
    world.figures[figure].pieces.push_back(line);
    run(world, 6);
    for (const auto corner : {crate[2], crate[3]})
        for (std::size_t i = 0; i + 1 < rope.size(); ++i) {
            const auto a = *position_of(world, rope[i]), b = *position_of(world, rope[i + 1]),
                       c = *position_of(world, corner);
            const auto t = collide::nearest_parameter(a, b, c);
            EXPECT_GT(double(distance(a + (b - a) * t, c)), 0.05 - 0.01);
        }
    EXPECT_LT(double((*position_of(world, rope[0]))[1]), 0.9);
    EXPECT_LT(stretch(world).max, 1e-3);
}

/// A trunk with a head and an arm: the neck lies in line with the shoulders, and one link of the trunk is redundant.
template <class Real> std::vector<ParticleId> add_torso(FlatWorld<Real>& world, std::uint64_t seed, double speed) {
    const auto figure = add_touching(world, 0.5);
    std::vector<ParticleId> all;
    std::uint64_t drawn = 0;
    const auto random_speed = [&] { return Real(speed * random::symmetric<double>(seed, 1, drawn++)); };
    constexpr std::array<std::array<double, 3>, 8> joints{{{-0.1, 0.4, 9},
                                                           {0.1, 0.4, 9},
                                                           {0, 0.4, 7},
                                                           {0, 0.6, 6},
                                                           {-0.1, 0, 18},
                                                           {0.1, 0, 18},
                                                           {0.4, 0.4, 2.5},
                                                           {0.65, 0.4, 1.1}}};
    for (const auto& [x, y, mass] : joints)
        all.push_back(add_particle(world, {.position = {{Real(x), Real(y)}},
                                           .velocity = {{random_speed(), random_speed()}},
                                           .mass = Real(mass),
                                           .radius = Real(0.03),
                                           .figure = figure}));
    for (const auto& [a, b] :
         {std::pair{0, 1}, {0, 2}, {1, 2}, {2, 3}, {0, 4}, {1, 5}, {4, 5}, {2, 4}, {2, 5}, {1, 6}, {6, 7}})
        add<Distance>(world, {all[std::size_t(a)], all[std::size_t(b)]}, {.figure = figure});
    add<Angle>(world, {all[1], all[6], all[7]}, {.limits = between(Real(-2), Real(0.5)), .figure = figure});
    for (const auto id : all) world.figures[figure].particles.push_back(id);
    return all;
}

// Links and joints act within a figure: they may take energy, never add any, and keep both momenta.
TYPED_TEST(Figures2, LinksOfAThrownFigureAddNoEnergy) {
    using Real = TypeParam;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        FlatWorld<Real> world;
        add_torso(world, seed, 30);
        step(world, Real(1.0 / 60));
        const auto momentum_before = momentum(world);
        double kinetic = energy(world).kinetic;
        for (int i = 0; i < 240; ++i) {
            step(world, Real(1.0 / 60));
            const double now = energy(world).kinetic;
            ASSERT_LE(now, kinetic * (1 + 1e-5)) << seed << ' ' << i;
            kinetic = now;
            ASSERT_LT(stretch(world).max, 1e-3) << seed << ' ' << i;
        }
        constexpr double rounding = 1e-5; // of 3840 substeps in floats
        EXPECT_LT(double(norm(momentum(world) - momentum_before)), rounding * 70 * 30);
    }
}

// The far end of a rod that turns about the other keeps its speed, as for a rigid body.
TYPED_TEST(Figures2, ATurningRodKeepsItsSpeed) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    const auto figure = add_touching(world, 0.5);
    const auto a = add_particle(world, {.position = {{-1, 0}}, .velocity = {{0, -5}}, .figure = figure});
    const auto b = add_particle(world, {.position = {{1, 0}}, .velocity = {{0, 5}}, .figure = figure});
    add<Distance>(world, {a, b}, {.figure = figure});
    run(world, 4);
    EXPECT_NEAR(double(norm(*velocity_of(world, a))), 5, 5e-3);
    EXPECT_NEAR(double(distance(*position_of(world, a), *position_of(world, b))), 2, 1e-4);
}

// A hand that pulls a hand pulls the whole figure: with a force F the centre of a mass M gains F t / M, at any force.
TYPED_TEST(Figures2, APinPullsTheWholeFigureWithItsForce) {
    using Real = TypeParam;
    for (const double force : {70.6, 7060.0, 70600.0}) {
        FlatWorld<Real> world;
        const auto torso = add_torso(world, 0, 0);
        const double mass = 70.6;
        pin(world, torso[7], PinSpec<2, Real>{.target = V2<Real>{{Real(1e4), Real(0)}}, .max_force = Real(force)});
        for (int i = 0; i < 30; ++i) {
            step(world, Real(1.0 / 60));
            ASSERT_LT(stretch(world).max, 1e-2) << force << ' ' << i;
        }
        const double speed = double(norm(momentum(world))) / mass;
        EXPECT_NEAR(speed, force / mass / 2, 0.02 * force / mass);
    }
}

/// A rope of 0.2 kg and 1 m, folded in two below a pin at the origin, with a weight at the other end.
template <class Real> std::vector<ParticleId> add_folded_rope(FlatWorld<Real>& world, double weight) {
    const auto figure = add_touching(world, 0.5);
    constexpr int pieces = 20;
    std::vector<ParticleId> rope;
    for (int i = 0; i <= pieces; ++i) {
        const double along = double(i) / pieces, down = along < 0.5 ? along : 1 - along;
        rope.push_back(add_particle(world, {.position = {{Real(0.1 * along), Real(-0.99 * down)}},
                                            .mass = Real(i == pieces ? weight : 0.01),
                                            .radius = Real(0.01),
                                            .figure = figure}));
        if (i > 0)
            add<Distance>(world, {rope[std::size_t(i) - 1], rope.back()},
                          {.limits = at_most(Real(1.0 / pieces)), .figure = figure});
    }
    pin(world, rope[0]);
    return rope;
}

// A weight of a hundred times the rope's mass falls as if free while the rope is slack.
TYPED_TEST(Figures2, ASlackRopeDoesNotHold) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    fall(world, 10);
    const auto rope = add_folded_rope(world, 20);
    run(world, 0.4);
    EXPECT_NEAR(double((*position_of(world, rope.back()))[1]), -10 * 0.4 * 0.4 / 2, 0.01);
}

// A rope that snaps taut is not stretched. With the usual substeps that holds for a weight of 20 times a particle's
// mass; one of 2000 times takes 64 (docs/concepts/contact.md, "Limits").
TYPED_TEST(Figures2, ARopeThatSnapsTautHolds) {
    using Real = TypeParam;
    for (const auto& [weight, substeps] : {std::pair{0.2, 0}, {20.0, 64}}) {
        FlatWorld<Real> world;
        fall(world, 10);
        world.settings.substeps = substeps;
        const auto rope = add_folded_rope(world, weight);
        for (int i = 0; i < 264; ++i) {
            step(world, Real(1.0 / 60));
            for (std::size_t k = 1; k < rope.size(); ++k)
                ASSERT_LT(double(distance(*position_of(world, rope[k - 1]), *position_of(world, rope[k]))), 1.0001 / 20)
                    << weight << ' ' << i;
        }
    }
}

// A hundred times the weight of the figure does not press its limbs through the floor.
TYPED_TEST(Figures2, AHandDoesNotPressAFigureThroughTheFloor) {
    using Real = TypeParam;
    for (const double x : {-3.0, 0.0, 2.0}) {
        FlatWorld<Real> world;
        add_ground(world);
        world.bounds.back().offset = Real(-0.5);
        const auto torso = add_torso(world, 0, 0);
        pin(world, torso[3], PinSpec<2, Real>{.target = V2<Real>{{Real(x), Real(-1)}}, .max_force = Real(70600)});
        for (int i = 0; i < 120; ++i) {
            step(world, Real(1.0 / 60));
            for (const auto id : torso) ASSERT_GT(double((*position_of(world, id))[1]), -0.5) << x << ' ' << i;
        }
        EXPECT_LT(stretch(world).max, 1e-3);
    }
}

// Limits of joints beside contacts: an arm that hangs at its limit lies still.
TYPED_TEST(Figures2, AFigureAtItsJointLimitsRests) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    add_ground(world);
    add_torso(world, 0, 0);
    world.settings.damping = 1;
    run(world, 20);
    EXPECT_LT(mean_speed(world), 1e-3);
    EXPECT_LT(stretch(world).max, 1e-4);
}

// Kept multipliers are state: a copy goes on alike, on any number of threads.
TYPED_TEST(Figures2, CopiesHaveTheSameFuture) {
    using Real = TypeParam;
    FlatWorld<Real> world;
    add_ground(world);
    for (int i = 0; i < 12; ++i) add_crate(world, 0.3 * (i % 4), 0.7 + 1.1 * i, 0.8, 1 + i % 3, 0.4 * i);
    const auto figure = add_touching(world, 0.5, true);
    for (int i = 0; i < 20; ++i)
        add_particle(world,
                     {.position = {{Real(-1 + 0.23 * i), Real(8 + 0.1 * i)}}, .radius = Real(0.1), .figure = figure});
    for (int i = 0; i < 120; ++i) {
        FlatWorld<Real> copy = world;
        copy.solver.options.threads = 3;
        step(world, Real(1.0 / 60));
        step(copy, Real(1.0 / 60));
        ASSERT_EQ(state_hash(copy), state_hash(world)) << i;
    }
}

// Ragdolls that fall on each other, enough for several threads and strips.
TEST(Pile, HashesTheSameOnAnyThreadsAndLanes) {
    const auto work = bench::find_contact_case("pile-280")->family->build(280);
    const auto hash_with = [&](int threads, Simd simd) {
        FlatWorld<float> world = bench::contact_world(work, 8);
        world.solver.options.threads = threads;
        world.solver.options.simd = simd;
        for (int i = 0; i < 75; ++i) step(world, 1.0F / 60);
        EXPECT_GT(world.contacts.kept.size(), 100U);
        return state_hash(world);
    };
    const auto expected = hash_with(1, best_simd());
    EXPECT_EQ(hash_with(2, Simd::sse2), expected);
    EXPECT_EQ(hash_with(4, Simd::avx2), expected);
}

// Without internal damping free arms swing on.
TEST(Pile, NoLimbCrossesAnotherAndAllComeToRest) {
    if (test::sanitized) GTEST_SKIP() << "takes a minute";
    const auto work = bench::find_contact_case("pile-80")->family->build(80);
    FlatWorld<float> world = bench::contact_world(work, 0);
    for (auto& figure : world.figures) figure.internal_damping = 2;
    bench::ContactState state;
    for (int i = 0; i < 600; ++i) {
        step(world, 1.0F / 60);
        if (i % 10 != 9) continue;
        state = look_at(work, world);
        ASSERT_EQ(state.crossed, 0) << i;
        ASSERT_LT(state.longest, 1e-3) << i;
    }
    EXPECT_LT(state.speed, 1e-3);
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

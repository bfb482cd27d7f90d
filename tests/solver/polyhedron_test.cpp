#include "sinew/prefab/prefabs.h"
#include "sinew/world/colliders.h"

#include "tests/dice.h"
#include "tests/flight.h"
#include "tests/thorough.h"
#include "tests/worlds.h"

#include <algorithm>
#include <array>
#include <cmath>

/// Crates in space: small things lie on faces, fast ones do not pass through, nested ones come out.
namespace sinew::SINEW_TEST_FILE {
namespace {

using namespace test;

template <class Real> struct Polyhedron : ::testing::Test {};
using Precisions = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Polyhedron, Precisions);

template <class Real> using Space = Stepped<3, Real>;

template <class Real> Space<Real> space(bool has_floor = true) {
    Space<Real> world;
    if (!has_floor) return world;
    fall(world, 9.81);
    world.bounds = {{at<Vec3<Real>>(0, 1), 0, Real(0.5), 0}};
    return world;
}
template <class Real, class Prefab>
FigureIndex put(Space<Real>& world, const Prefab& prefab, const Vec3<Real>& place, double friction = 0.5,
                double bounce = 0) {
    const auto figure = build(world, prefab, "f" + std::to_string(world.figures.size()), {.at = place});
    set_contact(world, figure, {.figures = true, .friction = friction, .bounce = bounce});
    return figure;
}
double any_of(Dice& dice, std::initializer_list<double> values) {
    return values.begin()[dice.below(int(values.size()))];
}
Box crate(double size, double mass, double dot) {
    return {.width = size, .height = size, .depth = size, .mass = mass, .thickness = dot, .dot = dot};
}
template <class Real> Vec3<double> place_of(const Space<Real>& world, ParticleId id) {
    return cast<double>(world.particles.position[world.particles.handles.find(id).value()]);
}
template <class Real> std::vector<Vec3<double>> places(const Space<Real>& world, FigureIndex figure) {
    std::vector<Vec3<double>> all;
    for (const auto id : world.figures[figure].particles) all.push_back(place_of(world, id));
    return all;
}
template <class Real> Vec3<double> middle_of(const Space<Real>& world, FigureIndex figure) {
    Vec3<double> sum{};
    const auto all = places(world, figure);
    for (const auto& x : all) sum += x * (1.0 / double(all.size()));
    return sum;
}
/// Turns a figure about the middle, by an angle about each axis.
template <class Real> void turn(Space<Real>& world, FigureIndex figure, const std::array<double, 3>& angles) {
    const auto middle = middle_of(world, figure);
    for (const auto id : world.figures[figure].particles) {
        auto x = place_of(world, id) - middle;
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            const double c = std::cos(angles[std::size_t(axis)]), s = std::sin(angles[std::size_t(axis)]);
            const double from = x[u];
            x[u] = c * from - s * x[v], x[v] = s * from + c * x[v];
        }
        set_position(world, id, cast<Real>(x + middle));
    }
}
/// Largest depth of a particle of other figures inside a crate.
template <class Real> double depth_in(const Space<Real>& world, FigureIndex figure) {
    const auto corner = places(world, figure);
    double deepest = 0;
    for (FigureIndex other = 0; other < world.figures.size(); ++other) {
        if (other == figure) continue;
        for (const auto& x : places(world, other)) {
            double depth = 1e9;
            for (const std::size_t k : {1, 2, 4}) {
                const auto side = corner[k] - corner[0];
                const double length = norm(side), along = dot(x - corner[0], side) / length;
                depth = std::min({depth, along, length - along});
            }
            deepest = std::max(deepest, depth);
        }
    }
    return deepest;
}
template <class Real> double fastest(const Space<Real>& world) {
    double most = 0;
    for (const auto& v : world.particles.velocity) most = std::max(most, double(norm(v)));
    return most;
}

// A ball and a crate rest on the face of a larger crate, at the right height, for all sizes, masses and corners.
TYPED_TEST(Polyhedron, WhatIsSmallerThanAFaceRestsOnIt) {
    using Real = TypeParam;
    int number = 0;
    for (const double scale : {0.05, 1.0, 20.0})
        for (const double dot : {0.0, 0.05})
            for (const double mass : {1e-3, 1.0, 1e3})
                for (const double size : {0.02, 0.1, 0.4})
                    for (const bool is_ball : {true, false}) {
                        if (++number % one_of(11) != 0) continue;
                        auto world = space<Real>();
                        const double top = scale * (1 + dot);
                        put(world, crate(scale, 1, dot * scale), at<Vec3<Real>>(0, scale * (0.5 + dot / 2)));
                        const double aside = is_ball ? 0 : 0.13; // a soft floor gives way, and a ball rolls off
                        const double radius = is_ball ? size * scale : dot * size * scale / 2;
                        const double half = (is_ball ? 0 : size * scale / 2) + radius;
                        const auto place = Vec3<Real>{
                            {Real(aside * scale), Real(top + half + 0.05 * scale), Real(1.5 * aside * scale)}};
                        const auto figure = is_ball ? put(world, Ball{.radius = radius, .mass = mass}, place)
                                                    : put(world, crate(size * scale, mass, dot * size * scale), place);
                        run(world, lasting(3));
                        const auto middle = middle_of(world, figure);
                        const auto text = [&] {
                            return "scale " + std::to_string(scale) + " dot " + std::to_string(dot) + " mass " +
                                   std::to_string(mass) + " size " + std::to_string(size) +
                                   (is_ball ? " ball" : " crate");
                        };
                        EXPECT_NEAR(middle[1], top + half, 2e-3 * scale) << text();
                        EXPECT_NEAR(middle[0], aside * scale, 2e-2 * scale) << text();
                        EXPECT_LT(fastest(world), 0.02 * std::sqrt(scale)) << text();
                    }
}

// Crates that begin inside each other, in any place and turned in any way, part gently and rest.
TYPED_TEST(Polyhedron, CratesThatBeginInsideEachOtherPart) {
    using Real = TypeParam;
    for (int seed = 1; seed <= few_or_many(12, 200); ++seed) {
        Dice dice{std::uint64_t(seed)};
        auto world = space<Real>();
        const double dot = any_of(dice, {0.0, 0.02, 0.1}), mass = any_of(dice, {0.01, 1.0, 100.0});
        std::vector<FigureIndex> crates;
        for (int i = 0; i < 2; ++i) {
            const auto place =
                i == 0
                    ? Vec3<double>{{0, 1.2, 0}}
                    : Vec3<double>{{dice.between(-0.4, 0.4), 1.2 + dice.between(-0.4, 0.4), dice.between(-0.4, 0.4)}};
            crates.push_back(
                put(world, crate(i == 0 ? 1 : dice.between(0.3, 1.2), i == 0 ? 1 : mass, dot), cast<Real>(place)));
            if (dice.between(0, 1) < 0.7)
                turn(world, crates.back(), {dice.between(-3, 3), dice.between(-3, 3), dice.between(-3, 3)});
        }
        double most = 0;
        for (int i = 0; i < int(lasting(6) * 60); ++i) {
            step(world, Real(1) / 60);
            most = std::max(most, fastest(world));
        }
        const double slack = 1e-3;
        if (lasting(6) < 6) continue;
        EXPECT_LT(depth_in(world, crates[0]), slack) << seed;
        EXPECT_LT(depth_in(world, crates[1]), slack) << seed;
        EXPECT_LT(most, 9) << seed << ": sqrt(2 g h) of a fall from 2 m is 6.3 m/s, and corners turn";
    }
}

// Balls shot at a crate strike it at any speed, with all momentum kept.
TYPED_TEST(Polyhedron, NothingPassesThroughACrate) {
    using Real = TypeParam;
    for (const double speed : {1.0, 10.0, 100.0, 1000.0})
        for (const double radius : {0.0, 0.02, 0.1})
            for (int seed = 1; seed <= few_or_many(4, 40); ++seed) {
                Dice dice{std::uint64_t(seed)};
                auto world = space<Real>(false);
                const auto target = put(world, crate(1, 10, 0.05), {});
                turn(world, target, {dice.between(-3, 3), dice.between(-3, 3), dice.between(-3, 3)});
                const auto ball = put(world, Ball{.radius = std::max(radius, 1e-6), .mass = 0.3},
                                      Vec3<Real>{{Real(dice.between(2, 4)), Real(dice.between(-0.2, 0.2)),
                                                  Real(dice.between(-0.2, 0.2))}});
                set_velocity(world, world.figures[ball].particles[0], at<Vec3<Real>>(-speed, 0));
                run(world, 6 / speed + 0.1, std::max(60.0, speed / 5));
                Vec3<double> momentum{};
                for (Row row = 0; row < world.particles.size(); ++row)
                    momentum +=
                        cast<double>(world.particles.velocity[row]) * (1 / double(world.particles.mobility[row]));
                EXPECT_NEAR(momentum[0], -0.3 * speed, (sizeof(Real) == 8 ? 1e-7 : 1e-4) * speed);
                const auto left = -world.particles.velocity[world.particles.size() - 1][0];
                EXPECT_LT(left, 0.8 * speed)
                    << "as along a face: speed " << speed << " radius " << radius << " seed " << seed;
                EXPECT_LT(depth_in(world, target), 0.02) << "speed " << speed << " seed " << seed;
            }
}

// Heaps of crates and balls of unlike sizes and masses, thrown together: no particle ends inside a crate.
TYPED_TEST(Polyhedron, NothingNestsInAHeap) {
    using Real = TypeParam;
    for (int seed = 1; seed <= few_or_many(6, 100); ++seed) {
        Dice dice{std::uint64_t(seed)};
        auto world = space<Real>();
        const double bounce = any_of(dice, {0.0, 0.5, 1.0}), friction = any_of(dice, {0.0, 0.5});
        world.bounds[0].restitution = Real(bounce);
        std::vector<FigureIndex> crates;
        double height = 0.8;
        for (int i = 0; i < 6; ++i) {
            const double size = dice.between(0.1, 1), mass = std::pow(10.0, dice.between(-1, 2));
            const auto place = cast<Real>(Vec3<double>{{dice.between(-0.3, 0.3), height, dice.between(-0.3, 0.3)}});
            height += 1.2;
            if (i % 3 == 2) {
                put(world, Ball{.radius = size / 5, .mass = mass}, place, friction, bounce);
                continue;
            }
            const double dot = any_of(dice, {0.0, 0.05}) * size;
            crates.push_back(put(world, crate(size, mass, dot), place, friction, bounce));
            turn(world, crates.back(), {dice.between(-3, 3), dice.between(-3, 3), dice.between(-3, 3)});
        }
        const auto begun = energy(world);
        const double put_in = begun.kinetic + begun.potential;
        for (int i = 0; i < int(lasting(5) * 60); ++i) {
            step(world, Real(1) / 60);
            const auto now = energy(world);
            ASSERT_LT(now.kinetic + now.potential, (1 + 1e-3) * put_in) << "seed " << seed << " step " << i;
        }
        for (const auto figure : crates) EXPECT_LT(depth_in(world, figure), 5e-3) << "seed " << seed;
    }
}

// A stack of crates stands, each turned against the last, with corners within faces.
TYPED_TEST(Polyhedron, ATwistedStackStands) {
    using Real = TypeParam;
    for (const double dot : {0.0, 0.05})
        for (const double size : {0.1, 1.0, 20.0}) {
            auto world = space<Real>();
            std::vector<FigureIndex> crates;
            for (int i = 0; i < 5; ++i) {
                crates.push_back(put(world, crate(size * (1 - 0.1 * i), 1, dot * size),
                                     at<Vec3<Real>>(0, size * (0.5 + i * (1 + dot) - 0.05 * i * i + dot / 2))));
                turn(world, crates.back(), {0, 0.5 * i, 0});
            }
            std::vector<double> heights;
            for (const auto figure : crates) heights.push_back(middle_of(world, figure)[1]);
            run(world, lasting(5));
            for (std::size_t i = 0; i < crates.size(); ++i) {
                const auto middle = middle_of(world, crates[i]);
                EXPECT_NEAR(middle[1], heights[i], 5e-3 * size) << "dot " << dot << " size " << size << " crate " << i;
                EXPECT_LT(std::hypot(middle[0], middle[2]), 2e-2 * size) << "dot " << dot << " size " << size;
            }
        }
}

// A crate rests on a post narrower than a face: a ball, a box, and a capsule, upright or flat.
TYPED_TEST(Polyhedron, ACrateRestsOnAPost) {
    using Real = TypeParam;
    using Vector = Vec3<Real>;
    for (const double size : {0.1, 1.0, 20.0})
        for (const double dot : {0.0, 0.05})
            for (int post = 0; post < 4; ++post) {
                auto world = space<Real>();
                collide::Collider<3, Real> collider;
                const auto third = Real(size / 3);
                if (post == 0) collider.shape = collide::Sphere<3, Real>{third};
                if (post == 1) collider.shape = collide::Box<3, Real>{Vector{{third, 2 * third, third}}};
                if (post == 2)
                    collider.shape =
                        collide::Capsule<3, Real>{at<Vector>(0, -1), at<Vector>(0, double(third) / 2), third / 2};
                if (post == 3)
                    collider.shape =
                        collide::Capsule<3, Real>{at<Vector>(-double(third), 0), at<Vector>(double(third), 0), third};
                add_collider(world, collider);
                const double top = size / 3;
                const auto figure = put(world, crate(size, 2, dot * size), at<Vector>(0, top + size * (0.6 + dot / 2)));
                if (post == 1 || post == 3) turn(world, figure, {0, 0.3, 0});
                run(world, (post == 1 ? 3 : 0.6) * std::sqrt(size)); // round posts are no lasting support
                EXPECT_NEAR(middle_of(world, figure)[1], top + size * (0.5 + dot / 2), 3e-3 * size)
                    << "size " << size << " dot " << dot << " post " << post;
            }
}

// A copy made in any step of a heap goes where the original goes.
TYPED_TEST(Polyhedron, ACopyGoesWhereTheOriginalGoes) {
    using Real = TypeParam;
    auto world = space<Real>();
    put(world, crate(1, 1, 0.05), at<Vec3<Real>>(0, 0.6));
    turn(world, put(world, crate(0.4, 30, 0.02), at<Vec3<Real>>(0.1, 1.6)), {0.3, 0.2, 0.9});
    put(world, Ball{.radius = 0.05, .mass = 0.2}, at<Vec3<Real>>(-0.2, 1.4));
    for (int i = 0; i < 90; ++i) {
        auto copy = world;
        step(world, Real(1) / 60);
        step(copy, Real(1) / 60);
        ASSERT_EQ(state_hash(world), state_hash(copy)) << "step " << i;
    }
}

} // namespace
} // namespace sinew::SINEW_TEST_FILE

#pragma once

#include "sinew/math/random.h"
#include "sinew/world/edit.h"
#include "sinew/world/measure.h"

#include "tests/constants.h"
#include "tests/sanitized.h"
#include "tests/stepped.h"

#include <gtest/gtest.h>
#include <string>
#include <type_traits>
#include <vector>

/// Small worlds for tests.
namespace sinew::test {

/// A dimension and a precision, for typed tests.
template <int D, class RealT> struct In {
    static constexpr int dimension = D;
    using Real = RealT;
    using World = test::Stepped<D, Real>;
    using Vector = Vec<D, Real>;
    static constexpr bool precise = sizeof(Real) == 8;
};

/// Each dimension in each precision. Under the sanitizers each dimension and each precision once: the other two are
/// instantiations of the same templates.
using Everywhere = std::conditional_t<sanitized, ::testing::Types<In<2, float>, In<3, double>>,
                                      ::testing::Types<In<2, float>, In<2, double>, In<3, float>, In<3, double>>>;

struct Names {
    template <class Type> static std::string GetName(int) {
        return std::to_string(Type::dimension) + "D" + (Type::precise ? "double" : "float");
    }
};

/// (x, y) or (x, y, 0).
template <class Vector> Vector at(double x, double y) {
    Vector position{};
    position[0] = decltype(position[0] + 0)(x);
    position[1] = decltype(position[0] + 0)(y);
    return position;
}

template <class World> void fall(World& world, double g) {
    using Real = typename World::Real;
    world.forces.push_back(Gravity<World::dimension, Real>{at<typename World::Vector>(0, -g)});
}

/// Mean speed of the particles, m/s.
template <class World> double mean_speed(const World& world) {
    double sum = 0;
    for (const auto& velocity : world.particles.velocity) sum += double(norm(velocity));
    return sum / double(world.particles.size());
}

/// Steps `seconds` on at `rate` steps a second.
template <class World> void run(World& world, double seconds, double rate = 60) {
    using Real = typename World::Real;
    const int steps = int(seconds * rate + 0.5);
    for (int i = 0; i < steps; ++i) step(world, Real(1 / rate));
}

/// Links each particle to the next by a distance, and the last to the first of a ring.
template <class World, class Ids> void link_in_turn(World& world, const Ids& ids, bool is_ring = false) {
    for (std::size_t i = 0; i + 1 < ids.size(); ++i) add<Distance>(world, {ids[i], ids[i + 1]});
    if (is_ring) add<Distance>(world, {ids[ids.size() - 1], ids[0]});
}

/// A row of particles from `from`, `spacing` apart, each linked to the next by a distance; unit masses.
template <class World>
std::vector<ParticleId> chain(World& world, int particles, typename World::Vector from,
                              typename World::Vector spacing) {
    using Real = typename World::Real;
    std::vector<ParticleId> ids;
    for (int i = 0; i < particles; ++i) ids.push_back(add_particle(world, {.position = from + spacing * Real(i)}));
    link_in_turn(world, ids);
    return ids;
}

/// Something of everything, moving: links of every kind of limit, soft and hard, a tearing link, pins hard, moving and
/// soft, forces of every kind, bounds with bounce and friction. Two figures.
template <int D, class Real> test::Stepped<D, Real> menagerie(Mode mode = Mode::physical) {
    using Vector = Vec<D, Real>;
    test::Stepped<D, Real> world;
    world.settings.mode = mode;
    world.settings.substeps = 4;
    world.settings.damping = Real(0.1);
    world.settings.classic = {.passes = 2, .keep = Real(0.99), .bounce = Real(0.5), .floor_keep = Real(0.9)};
    world.forces = {Gravity<D, Real>{at<Vector>(0, -10)}, Drag<D, Real>{Real(0.05)},
                    Wind<D, Real>{.velocity = at<Vector>(2, 0), .strength = Real(0.1), .gust = at<Vector>(1, 1)},
                    Attractor<D, Real>{.center = at<Vector>(3, 3), .strength = 5},
                    RandomPush<D, Real>{at<Vector>(-2, 0), at<Vector>(6, 3), 11}};
    world.bounds = {{at<Vector>(0, 1), -6, Real(0.5), Real(0.3)}, {at<Vector>(1, 0), -6, 0, 0}};

    const auto rope = chain(world, 8, at<Vector>(-4, 2), at<Vector>(0.5, 0.1));
    pin(world, rope[0]);
    const FigureIndex body = add_figure(world, "body");
    std::vector<ParticleId> p;
    for (int i = 0; i < 6; ++i) {
        Vector position{};
        for (int axis = 0; axis < D; ++axis)
            position[axis] = random::symmetric<Real>(5, std::uint64_t(i), std::uint64_t(axis));
        p.push_back(
            add_particle(world, {.position = position, .mass = Real(1 + i), .radius = Real(0.1), .figure = body}));
    }
    world.figures[body].particles = p;
    add<Distance>(world, {p[0], p[1]}, {.limits = at_most(Real(1)), .figure = body});
    add<Distance>(world, {p[1], p[2]}, {.limits = at_least(Real(0.5)), .compliance = Real(1e-3)});
    add<Distance>(world, {p[2], p[3]}, {.limits = between(Real(0.4), Real(0.8)), .relaxation = Real(0.7)});
    add<Distance>(world, {p[3], p[4]}, {.split = Real(0.2), .breaking_strain = Real(1e-4)});
    add<Angle>(world, {p[0], p[1], p[2]}, {.limits = between(Real(0.2), Real(1)), .compliance = Real(1e-2)});
    if constexpr (D == 2) {
        add<Area>(world, {p[0], p[1], p[2], p[4], p[5]}, {.compliance = Real(1e-4), .breaking_strain = Real(5)});
    } else {
        add<Volume>(world, {p[0], p[1], p[2], p[3]}, {.compliance = Real(1e-4)});
        add<Dihedral>(world, {p[1], p[2], p[3], p[4]}, {.compliance = Real(1e-2), .breaking_strain = Real(20)});
    }
    pin(world, p[5], {.target = at<Vector>(2, 2), .compliance = Real(1e-2), .max_force = Real(300)});
    const auto carried = pin(world, rope[7]);
    move_pin(world, *carried, at<Vector>(1, 1));
    apply_impulse(world, p[4], at<Vector>(3, 1));
    return world;
}

} // namespace sinew::test

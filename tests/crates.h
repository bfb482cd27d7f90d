#pragma once

#include "sinew/world/colliders.h"

#include "tests/worlds.h"

#include <string>
#include <utility>
#include <vector>

/// Crates and discs that collide, in a plane.
namespace sinew::test {

template <class Real> using FlatWorld = test::Stepped<2, Real>;
template <class Real> using V2 = Vec<2, Real>;

template <class Real> FigureIndex add_touching(FlatWorld<Real>& world, double friction, bool itself = false) {
    const auto figure = add_figure(world, "figure" + std::to_string(world.figures.size()));
    set_contact(world, figure, {.figures = true, .itself = itself, .friction = friction});
    return figure;
}

/// A rigid square of four particles and six links; its outline is `size` wide, radii included.
template <class Real>
std::vector<ParticleId> add_crate(FlatWorld<Real>& world, double x, double y, double size, double mass, double turn = 0,
                                  double friction = 0.5, double radius = 0.02) {
    const auto figure = add_touching(world, friction);
    const double half = size / 2 - radius, c = std::cos(turn), s = std::sin(turn);
    std::vector<ParticleId> corners;
    for (const auto& [u, v] : {std::pair{-half, -half}, {half, -half}, {half, half}, {-half, half}})
        corners.push_back(add_particle(world, {.position = {{Real(x + c * u - s * v), Real(y + s * u + c * v)}},
                                               .mass = Real(mass / 4),
                                               .radius = Real(radius),
                                               .figure = figure}));
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t k = i + 1; k < 4; ++k) add<Distance>(world, {corners[i], corners[k]}, {.figure = figure});
    Piece inside{.mark = Mark::fill};
    for (const auto id : corners) inside.particles.push_back(id), world.figures[figure].particles.push_back(id);
    world.figures[figure].pieces.push_back(inside);
    return corners;
}

template <class Real> void add_ground(FlatWorld<Real>& world, double angle = 0, double friction = 0.5) {
    fall(world, 10);
    world.bounds.push_back({{{Real(-std::sin(angle)), Real(std::cos(angle))}}, 0, 0, Real(friction)});
}

template <class Real> V2<Real> middle_of(const FlatWorld<Real>& world, const std::vector<ParticleId>& ids) {
    V2<Real> sum{};
    for (const auto id : ids) sum += *position_of(world, id) * (Real(1) / Real(ids.size()));
    return sum;
}

} // namespace sinew::test

#pragma once

#include "sinew/world/world.h"

namespace sinew::detail {

/// How a particle and a wall rub and bounce: the larger restitution of both counts, and the figure's friction in place
/// of the wall's where it has one against walls.
template <class Real> struct WallSurface { Real restitution = 0, friction = 0; };
template <int D, class Real, class Wall>
WallSurface<Real> surface_between(const World<D, Real>& world, Row row, const Wall& wall) {
    const auto index = world.particles.figure[row];
    if (index >= world.figures.size()) return {wall.restitution, wall.friction};
    const auto& figure = world.figures[index];
    return {max(wall.restitution, Real(figure.bounce)),
            figure.wall_friction ? Real(*figure.wall_friction) : wall.friction};
}

} // namespace sinew::detail

#pragma once

#include "sinew/collide/collider.h"
#include "sinew/solver/contact/collider_sweep.h"

#include <algorithm>

namespace sinew::detail {

/// True if the middle of a particle is behind a plane, or inside a collider that holds it.
template <int D, class Real> bool is_behind_walls(const World<D, Real>& world, Row row) {
    const auto& position = world.particles.position[row];
    return std::ranges::any_of(world.bounds,
                               [&](const auto& plane) { return plane.depth_of(position, Real(0)) > Real(0); }) ||
           std::ranges::any_of(world.colliders, [&](const auto& collider) {
               if (collider.is_sensor || !touch(filter_of(world, row), collider.filter)) return false;
               const auto surface = collide::nearest(collider.shape, collider.target, position, Real(0));
               return surface && surface->distance < Real(0);
           });
}

} // namespace sinew::detail

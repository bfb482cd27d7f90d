#pragma once

#include "sinew/world/world.h"

/// Gravity, air and walls of a world, by name.
namespace sinew {

/// Replaces the world's gravity, length / time^2.
template <int D, class Real> void set_gravity(World<D, Real>& world, const Vec<D, Real>& acceleration) {
    std::erase_if(world.forces, [](const auto& force) { return std::holds_alternative<Gravity<D, Real>>(force); });
    world.forces.insert(world.forces.begin(), Gravity<D, Real>{acceleration});
}

/// Adds a wind: add_wind(world, {.velocity = {3, 0}, .strength = 0.1}).
template <int D, class Real> void add_wind(World<D, Real>& world, const Wind<D, Real>& wind) {
    world.forces.push_back(wind);
}

/// Adds a wall or floor: add_plane(world, {.normal = {0, 1}, .offset = -3, .friction = 0.5}). The normal need not have
/// unit length; the plane is dot(normal, x) = offset. A normal of zero adds nothing.
template <int D, class Real> void add_plane(World<D, Real>& world, HalfSpace<D, Real> plane) {
    const Real length = norm(plane.normal);
    if (!(length > Real(0))) return;
    plane.offset /= length;
    plane.normal = plane.normal * (Real(1) / length);
    world.bounds.push_back(plane);
}

/// Keeps all particles between two opposite corners.
template <int D, class Real>
void set_bounds(World<D, Real>& world, const Vec<D, Real>& low, const Vec<D, Real>& high, Real restitution = 0,
                Real friction = 0) {
    world.bounds.clear();
    for (int i = 0; i < D; ++i) {
        const auto axis = Vec<D, Real>::axis(i);
        world.bounds.push_back({axis, low[i], restitution, friction});
        world.bounds.push_back({axis * Real(-1), -high[i], restitution, friction});
    }
}

} // namespace sinew

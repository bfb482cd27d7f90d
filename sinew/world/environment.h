#pragma once

#include "sinew/world/world.h"

/// Gravity, air and walls of a world, by name.
namespace sinew {

/// The world's gravity: the first field of this kind; null if there is none.
template <int D, class Real> Gravity<D, Real>* gravity_of(World<D, Real>& world) {
    for (auto& force : world.forces)
        if (auto* gravity = std::get_if<Gravity<D, Real>>(&force)) return gravity;
    return nullptr;
}

/// Replaces the world's gravity, length / time^2. Other fields of this kind stay.
template <int D, class Real> void set_gravity(World<D, Real>& world, const Vec<D, Real>& acceleration) {
    if (auto* gravity = gravity_of(world))
        gravity->acceleration = acceleration;
    else
        world.forces.push_back(Gravity<D, Real>{acceleration});
}

/// Adds a force field: add_force(world, Wind<2, double>{.velocity = {3, 0}, .strength = 0.1}). world.forces.find(id)
/// reads and changes it, world.forces.remove(id) removes it.
template <int D, class Real>
ForceId add_force(World<D, Real>& world, const std::type_identity_t<Force<D, Real>>& force) {
    return world.forces.push_back(force);
}

/// Adds a wind: add_wind(world, {.velocity = {3, 0}, .strength = 0.1}).
template <int D, class Real> ForceId add_wind(World<D, Real>& world, const Wind<D, Real>& wind) {
    return world.forces.push_back(wind);
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

#pragma once

#include "sinew/scene/scene.h"

#include <vector>

/// From the section "colliders" of a scene to the colliders of a world.
namespace sinew {

/// Layers as bits; all of them if none are named.
collide::Filter filter_of(const std::vector<int>& layers, const std::optional<std::vector<int>>& touches);

/// Orientation after a spin for some time, in the scene's unit; `up`: -1 if y points down.
template <int D, class Real>
collide::Rotation<D, Real> rotation_of(const ColliderSection& section, double time, int up);

/// Colliders of a section, at the section's position: several for a polygon with dents, none for an invalid shape.
template <int D, class Real>
std::vector<collide::Collider<D, Real>> colliders_of(const ColliderSection& section, std::size_t index, int up);

/// Reports whatever makes the shape of a section invalid.
void check_collider(const ColliderSection& section, std::size_t index, int dimension, Document& document);

} // namespace sinew

#pragma once

#include "sinew/scene/scene.h"

#include <optional>

/// Motion of the colliders of a scene, a function of time and of the pointer.
namespace sinew {

enum class Arrival : bool {
    in_a_step, ///< evenly over the next step: what touches is carried along
    at_once
};

/// Moves the colliders to where they are at a time, in the scene's unit.
void move_colliders(const Scene& scene, const std::optional<Point>& pointer, double time, Arrival arrival,
                    AnyWorld& world);

} // namespace sinew

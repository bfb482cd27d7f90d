#pragma once

#include "sinew/scene/scene.h"

#include <array>

namespace sinew {

/// Two opposite corners of the box around the figures of a world, with a margin for swinging and the colliders near
/// them, or of the scene's bounds as far as these are near, in units of length.
std::array<Point, 2> focus_of(const Scene& scene, const AnyWorld& world);

/// True for the focus of a world without figures and bounds.
inline bool shows_nothing(const std::array<Point, 2>& focus) {
    return focus == std::array<Point, 2>{};
}

} // namespace sinew

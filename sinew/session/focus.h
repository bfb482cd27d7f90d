#pragma once

#include "sinew/scene/scene.h"

#include <array>

namespace sinew {

/// Two opposite corners of the box around the world, with a margin for swinging figures, or of the scene's bounds, in
/// units of length.
std::array<Point, 2> focus_of(const Scene& scene, const AnyWorld& world);

} // namespace sinew

#pragma once

#include "sinew/scene/scene.h"
#include "sinew/session/view.h"

#include <optional>

namespace sinew::play {

/// Corners of an obstacle's outline in a 2D scene where it begins; empty for planes.
std::vector<Vec2<double>> outline_of(const ColliderSection& obstacle, double up);

/// The last obstacle of a 2D scene at a pixel, or whose line is within `radius` pixels; those without an end are left
/// out.
std::optional<std::size_t> obstacle_at(const Scene& scene, const View& view, Vec2<double> pixel, double radius);

} // namespace sinew::play

#pragma once

#include "sinew/math/vec.h"

#include <span>
#include <vector>

namespace sinew::collide {

using Corners = std::vector<Vec2<double>>;

/// Convex parts of a simple polygon, each counter-clockwise; corners may go either way round. Empty for a polygon that
/// crosses itself or has no area. Ears are clipped (Meisters 1975), then triangles merged while they stay convex
/// (Hertel and Mehlhorn 1983).
std::vector<Corners> convex_parts(std::span<const Vec2<double>> corners);

} // namespace sinew::collide

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
/// Same for a polygon with holes, which neither touch it nor each other: bridges join them to the outline (Eberly,
/// "Triangulation by Ear Clipping", 2002). Empty where some bridge is not found.
std::vector<Corners> convex_parts(std::span<const Vec2<double>> outline, std::span<const Corners> holes);

/// Twice the signed area: positive for corners counter-clockwise in a y-up frame.
double twice_area(std::span<const Vec2<double>> corners);
/// True for a point inside a polygon.
bool is_inside(std::span<const Vec2<double>> corners, const Vec2<double>& point);
/// True if the outlines of two polygons cross.
bool cross_each_other(std::span<const Vec2<double>> a, std::span<const Vec2<double>> b);

} // namespace sinew::collide

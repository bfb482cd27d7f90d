#pragma once

#include "files/in/simplify.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace sinew::files {

/// Place on a grid: multiples of 1/1024 pixel. Coordinates of drawings, below 1e6 pixels, make 31 bits, so that the
/// product of two differences fits into 63.
using Spot = std::pair<std::int64_t, std::int64_t>;

Spot spot_of(const Vec2<double>& point);
Vec2<double> place_of(const Spot& spot);

/// Twice the area of a triangle: positive for a turn to the left in a y-up frame.
std::int64_t turn_of(const Spot& a, const Spot& b, const Spot& c);

using Segment = std::pair<Spot, Spot>;

/// Segments cut where two of them cross, touch or overlap, so that they have no points in common but their ends.
/// Crossings are rounded to the grid, which bends segments; pieces are cut again until none crosses. Nothing where
/// there would be too many.
std::optional<std::vector<Segment>> cut_at_crossings(std::vector<Segment> segments);

} // namespace sinew::files

#pragma once

#include "sinew/math/vec.h"

#include <span>
#include <vector>

/// Outlines in pixels, built from the projected particles of a piece.
namespace sinew {

using Pixels = std::vector<Vec2<float>>;

/// Polyline along a Catmull-Rom curve through `points`, written to `curve`.
void smooth(std::span<const Vec2<float>> points, Pixels& curve);

/// Convex hull of two discs, a tapered limb, written to `shape`. Widths are diameters.
void taper(Vec2<float> from, float from_width, Vec2<float> to, float to_width, Pixels& shape);

/// Centre line of a chain ring around two points, written to `loop`. `width`: outer width of the ring; `wire`:
/// thickness of the wire; both in pixels.
void ring(Vec2<float> from, Vec2<float> to, float width, float wire, Pixels& loop);

/// Offsets every side outwards by `by` pixels, so that neighbours overlap instead of leaving a seam.
void widen(Pixels& shape, float by);

} // namespace sinew

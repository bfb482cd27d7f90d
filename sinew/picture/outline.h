#pragma once

#include "sinew/math/vec.h"

#include <span>
#include <vector>

/// Shapes of pieces in pixels, made of the places of their particles.
namespace sinew {

using Pixels = std::vector<Vec2<float>>;

/// Points of a smooth curve through `points`, into `curve`.
void smooth(std::span<const Vec2<float>> points, Pixels& curve);

/// What two discs and the band between them cover, into `shape`: a limb that tapers.
void taper(Vec2<float> from, float from_width, Vec2<float> to, float to_width, Pixels& shape);

/// The middle line of a ring around two points, into `loop`: as wide as `width`, of a wire so thick.
void ring(Vec2<float> from, Vec2<float> to, float width, float wire, Pixels& loop);

/// Moves each side outwards, so that neighbours overlap instead of leaving a seam.
void widen(Pixels& shape, float by);

} // namespace sinew

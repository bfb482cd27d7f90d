#pragma once

#include "sinew/math/vec.h"

#include <vector>

namespace sinew::files {

using Outline = std::vector<Vec2<double>>;

/// The closed outline with fewer points, at most `error` away (Douglas and Peucker 1973). The two points furthest apart
/// from the first on stay.
Outline simplified_loop(const Outline& loop, double error);
/// The same for an open line, whose ends stay.
Outline simplified_line(const Outline& line, double error);

/// The outline with points added so that no edge is longer than `spacing`.
Outline subdivided(const Outline& outline, double spacing, bool closed);

double length_of(const Outline& outline, bool closed);

} // namespace sinew::files

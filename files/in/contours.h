#pragma once

#include "files/in/simplify.h"

#include <functional>

namespace sinew::files {

/// A field of numbers over pixels, whose middles are at (0.5, 0.5), ...
struct PixelField {
    int width = 0, height = 0;
    std::function<double(int x, int y)> at; ///< inside the field
};

/// Closed outlines at which the field is `level`, by marching squares (Lorensen and Cline 1987, in the plane): points
/// are where the level is between two pixels, by linear interpolation. The field is 0 around. Greater values are on the
/// right of an outline in coordinates with y downwards.
std::vector<Outline> contours(const PixelField& field, double level);

} // namespace sinew::files

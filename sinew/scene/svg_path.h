#pragma once

#include "sinew/math/vec.h"

#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Largest distance of a chord from its curve, as a share of the diagonal of the box around the path.
inline constexpr double svg_tolerance = 1.0 / 2000;

/// A subpath, curves as chords. The first point is not repeated at the end.
struct SvgOutline {
    std::vector<Vec2<double>> points;
    bool closed = false; ///< by Z, or by its last point
};

/// Subpaths of a path, in order; those of one point are left out.
struct SvgPath {
    std::vector<SvgOutline> outlines;
    std::string error; ///< first mistake with its place in the text; empty for a valid path
};

/// Reads the `d` of a path of SVG 2 (chapter 9.3: commands M L H V C S Q T A Z, absolute and relative). Numbers are
/// coordinates as they stand: nothing is turned over or scaled.
SvgPath read_svg_path(std::string_view text);

} // namespace sinew

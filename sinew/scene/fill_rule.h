#pragma once

#include "sinew/collide/decompose.h"
#include "sinew/scene/svg_path.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Rules of SVG by which a path of several outlines is filled.
inline constexpr std::array<std::string_view, 2> fill_rules{"nonzero", "evenodd"};

/// An outline with the holes in it.
struct SolidOutline {
    collide::Corners outline;
    std::vector<collide::Corners> holes;
};
struct SolidOutlines {
    std::vector<SolidOutline> solids;
    std::string error; ///< of outlines that cross where one of them is not filled; empty: none
};

/// Solids of a path: an outline is the border of a solid, of a hole, or of neither, by the winding on both sides of it.
/// Outlines that cross are united by `nonzero` if they go round the same way.
SolidOutlines solids_of(const std::vector<SvgOutline>& outlines, std::string_view fill_rule);

} // namespace sinew

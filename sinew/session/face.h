#pragma once

#include "sinew/session/picture.h"
#include "sinew/session/view.h"

#include <span>
#include <string_view>

namespace sinew {

/// A ball with a front: unit vectors to its upper side, its right side as one sees it, and its front.
struct Head {
    Vec3<double> middle{}, above{{0, 1, 0}}, right{{1, 0, 0}}, front{{0, 0, 1}};
    double radius = 0;
};

/// The head at the last of some places: upright, or turned as the way to it from the place before. In the plane it
/// looks at the reader; in space its right side is that of the way from the first place to the second, if there are
/// four.
Head head_at(std::span<const Vec3<double>> places, bool flat, const View& view, double radius);

/// Eyes and a mouth on a head, as far as they are seen. The expression is one of `expressions` (look_section.h).
void paint_face(const Head& head, std::string_view expression, const View& view, const Color& color, Picture& picture);

} // namespace sinew

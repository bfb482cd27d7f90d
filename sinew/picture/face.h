#pragma once

#include "sinew/picture/picture.h"
#include "sinew/session/view.h"

#include <span>
#include <string_view>

namespace sinew {

/// A sphere with a front: unit vectors upwards, to the right as the viewer sees the face, and to the front.
struct Head {
    Vec3<double> middle{}, above{{0, 1, 0}}, right{{1, 0, 0}}, front{{0, 0, 1}};
    double radius = 0;
};

/// Head centred on the last of `places`; the last segment, if any, points upwards. In 2D the face looks at the viewer.
/// In 3D, with at least four places, the segment from the first to the second gives the direction to the right.
Head head_at(std::span<const Vec3<double>> positions, bool flat, const View& view, double radius);

/// Paints eyes and mouth as far as they face the viewer. `expression`: one of `expressions` (look_section.h).
void paint_face(const Head& head, std::string_view expression, const View& view, const Color& color, Picture& picture);

} // namespace sinew

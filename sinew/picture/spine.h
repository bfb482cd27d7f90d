#pragma once

#include "sinew/math/bezier.h"
#include "sinew/picture/outline.h"

#include <span>
#include <vector>

/// What is long and bends: limbs, ropes.
namespace sinew {

/// A smooth line, piece by piece; each begins where the last ends.
using Bends = std::vector<CubicBezier<2, float>>;

/// The Bezier curve of a limb: 2 points are straight, of 3 and 4 those between pull the curve towards them; through
/// more it runs like a rope.
void limb_along(std::span<const Vec2<float>> points, Bends& bends);
/// The Catmull-Rom curve through all points.
void rope_through(std::span<const Vec2<float>> points, Bends& bends);

/// Places at even distances along a line, and the way it goes there (unit vectors).
struct Spine {
    Pixels place, along;
    float length = 0;

    std::size_t size() const { return place.size(); }
    /// How far along a place is: 0 at the beginning, 1 at the end.
    float share(std::size_t i) const { return size() < 2 ? 0 : float(i) / float(size() - 1); }
};

/// Measures the line and divides it into `parts` of equal length, or so that none is longer than `longest` where that
/// is more, up to `most_parts`.
void lay_out(std::span<const CubicBezier<2, float>> bends, std::size_t parts, float longest, Spine& spine);
inline constexpr std::size_t most_parts = 512;

/// How thick a limb is along its way, as multiples of its thickness at even distances; without any, 1 everywhere.
float thickness_at(std::span<const double> profile, float share);

/// Where the two sides of a band are, in turns: left, right, left, right. Where a bend is tighter than the band is
/// wide, the inner side stands still instead of running backwards.
template <class Width> void sides_of(const Spine& spine, Width&& width_at, Pixels& sides) {
    sides.clear();
    for (std::size_t i = 0; i < spine.size(); ++i) {
        const auto side = perpendicular(spine.along[i]) * (width_at(spine.share(i)) / 2);
        for (const auto& corner : {spine.place[i] - side, spine.place[i] + side}) {
            const bool backwards = i > 0 && dot(corner - sides[sides.size() - 2], spine.along[i]) < 0;
            sides.push_back(backwards ? sides[sides.size() - 2] : corner);
        }
    }
}

} // namespace sinew

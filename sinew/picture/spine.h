#pragma once

#include "sinew/math/bezier.h"
#include "sinew/picture/outline.h"

#include <span>
#include <vector>

/// Centre lines of long, bent pieces: limbs, ropes.
namespace sinew {

/// A smooth curve as connected cubic pieces.
using Bends = std::vector<CubicBezier<2, float>>;

/// Bezier curve of a limb through the first and the last point. 2 points: straight; 3 or 4: the inner points are
/// control points; more: as `rope_through`.
void limb_along(std::span<const Vec2<float>> points, Bends& bends);
/// Catmull-Rom curve through all points.
void rope_through(std::span<const Vec2<float>> points, Bends& bends);

/// Points equally spaced along a curve, with unit tangents.
struct Spine {
    Pixels position, along;
    float length = 0;

    std::size_t size() const { return position.size(); }
    /// Fraction of the length at point i: 0 at the beginning, 1 at the end.
    float share(std::size_t i) const { return size() < 2 ? 0 : float(i) / float(size() - 1); }
};

/// Resamples the curve into `parts` parts of equal length, or into as many more as keep each at most `longest`, up to
/// `max_parts`.
void lay_out(std::span<const CubicBezier<2, float>> bends, std::size_t parts, float longest, Spine& spine);
inline constexpr std::size_t max_parts = 512;

/// Width factor at a fraction of the length: linear interpolation of equally spaced factors; 1 for an empty profile.
float thickness_at(std::span<const double> profile, float share);

/// Sides of a band in turns: left, right, left, right. Where the bend's radius is below half the width, the inner side
/// pauses instead of running backwards.
template <class Width> void sides_of(const Spine& spine, Width&& width_at, Pixels& sides) {
    sides.clear();
    for (std::size_t i = 0; i < spine.size(); ++i) {
        const auto side = perpendicular(spine.along[i]) * (width_at(spine.share(i)) / 2);
        for (const auto& corner : {spine.position[i] - side, spine.position[i] + side}) {
            const bool backwards = i > 0 && dot(corner - sides[sides.size() - 2], spine.along[i]) < 0;
            sides.push_back(backwards ? sides[sides.size() - 2] : corner);
        }
    }
}

} // namespace sinew

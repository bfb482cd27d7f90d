#pragma once

#include "sinew/collide/surface_point.h"

#include <limits>
#include <optional>

/// Contacts of any convex part with `nearest(point)`, in the part's frame. The signed distance to a convex set is a
/// convex function, with the normal for gradient: all algorithms rest on that alone.
namespace sinew::collide {

/// Nearest approach of the segment a-b. The slope of the distance along the segment, dot(normal, b - a), only grows, so
/// its zero is found by bisection.
template <class Part, int D, class Real>
SegmentApproach<D, Real> nearest_to_segment(const Part& part, const Vec<D, Real>& a, const Vec<D, Real>& b) {
    const auto ab = b - a;
    const auto at = [&](Real t) { return SegmentApproach<D, Real>{t, part.nearest(a + ab * t)}; };
    const auto slope = [&](const SegmentApproach<D, Real>& point) { return dot(point.surface.normal, ab); };
    auto low = at(0), high = at(1);
    if (slope(low) >= Real(0)) return low;
    if (slope(high) <= Real(0)) return high;
    constexpr int halvings = std::numeric_limits<Real>::digits / 2 + 6; // the distance is flat at its minimum
    for (int i = 0; i < halvings; ++i) {
        const auto middle = at((low.t + high.t) * Real(0.5));
        (slope(middle) < Real(0) ? low : high) = middle;
    }
    return low.surface.distance < high.surface.distance ? low : high;
}

/// First contact of a capsule whose axis a-b moves by displacement_a, displacement_b; a sphere for a == b. The plane
/// through the nearest surface point has the part behind it and the axis before it, hence advancing until the axis
/// meets the plane never passes the contact (Newton's method from the outside of a convex function).
template <class Part, int D, class Real>
std::optional<Impact<D, Real>> sweep(const Part& part, const Vec<D, Real>& a, const Vec<D, Real>& b,
                                     const Vec<D, Real>& displacement_a, const Vec<D, Real>& displacement_b,
                                     Real radius) {
    constexpr int max = 64;
    const Real scale = norm(a) + norm(b) + norm(displacement_a) + norm(displacement_b) + radius;
    const Real rounding = Real(16) * std::numeric_limits<Real>::epsilon() * scale;
    Real time = 0;
    for (int i = 0;; ++i) {
        const auto approach = nearest_to_segment(part, a + displacement_a * time, b + displacement_b * time);
        const auto& n = approach.surface.normal;
        const Real speed = -min(dot(n, displacement_a), dot(n, displacement_b));
        if (!(speed > Real(0))) return std::nullopt;
        const Real gap = approach.surface.distance - radius;
        if (gap <= rounding || i == max) return Impact<D, Real>{time, approach.surface};
        time += gap / speed;
        if (!(time <= Real(1))) return std::nullopt;
    }
}

/// First contact of a moving sphere; of a ray for radius 0. A step that ends on the part is a contact, whichever normal
/// a corner has there: that of the plane which the step has reached.
template <class Part, int D, class Real>
std::optional<Impact<D, Real>> sweep(const Part& part, const Vec<D, Real>& from, const Vec<D, Real>& displacement,
                                     Real radius) {
    constexpr int max = 64;
    const Real rounding = Real(16) * std::numeric_limits<Real>::epsilon() * (norm(from) + norm(displacement) + radius);
    Real time = 0;
    SurfacePoint<D, Real> reached;
    for (int i = 0;; ++i) {
        auto surface = part.nearest(from + displacement * time);
        const Real speed = -dot(surface.normal, displacement), gap = surface.distance - radius;
        if (!(speed > Real(0))) {
            constexpr Real grain = 4;
            if (i == 0 || gap > grain * rounding) return std::nullopt;
            surface.normal = reached.normal, surface.feature = reached.feature;
            return Impact<D, Real>{time, surface};
        }
        if (gap <= rounding || i == max) return Impact<D, Real>{time, surface};
        reached = surface;
        time += gap / speed;
        if (!(time <= Real(1))) return std::nullopt;
    }
}

} // namespace sinew::collide

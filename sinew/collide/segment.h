#pragma once

#include "sinew/math/vec.h"

namespace sinew::collide {

/// Parameter of the point of the segment a-b nearest to a point, 0..1.
template <int D, class Real>
Real nearest_parameter(const Vec<D, Real>& a, const Vec<D, Real>& b, const Vec<D, Real>& point) {
    const auto ab = b - a;
    return clamp(dot(point - a, ab) * inverse_or_zero(dot(ab, ab)), Real(0), Real(1));
}

template <class Real> struct SegmentPair {
    Real s = 0, t = 0; ///< parameters of the nearest points on both segments, 0..1
};

/// Nearest points of the segments a-b and c-d (Ericson 2004, 5.1.9). For parallel segments: the first pair in the order
/// of s.
template <int D, class Real>
SegmentPair<Real> nearest_parameters(const Vec<D, Real>& a, const Vec<D, Real>& b, const Vec<D, Real>& c,
                                     const Vec<D, Real>& d) {
    const auto u = b - a, v = d - c, w = a - c;
    const Real uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
    const Real determinant = uu * vv - uv * uv;
    constexpr Real parallel = Real(64) * std::numeric_limits<Real>::epsilon();
    Real s = 0;
    if (determinant > parallel * uu * vv) s = clamp((uv * vw - vv * uw) / determinant, Real(0), Real(1));
    Real t = clamp((uv * s + vw) * inverse_or_zero(vv), Real(0), Real(1));
    s = clamp((uv * t - uw) * inverse_or_zero(uu), Real(0), Real(1));
    t = clamp((uv * s + vw) * inverse_or_zero(vv), Real(0), Real(1));
    return {s, t};
}

} // namespace sinew::collide

#pragma once

#include "sinew/solver/contact/contact_room.h"

/// Normals of segments, where nearest points leave none.
namespace sinew::detail {

template <int D, class Real> Vec<D, Real> normal_of(const Vec<D, Real>& away, const Vec<D, Real>& otherwise) {
    const Real per = inverse_or_zero(norm(away));
    return per > Real(0) ? away * per : otherwise;
}
/// Direction across two others; in the plane, across the first.
template <int D, class Real> Vec<D, Real> across(const Vec<D, Real>& u, [[maybe_unused]] const Vec<D, Real>& v) {
    if constexpr (D == 3)
        return normal_of(cross(u, v), Vec<D, Real>::axis(1));
    else
        return normal_of(perpendicular(u), Vec<D, Real>::axis(1));
}
/// Vector to the left of a segment from a to b; in space, some vector across it.
template <int D, class Real> Vec<D, Real> side_of(const Vec<D, Real>& a, const Vec<D, Real>& b) {
    using Vector = Vec<D, Real>;
    if constexpr (D == 2)
        return perpendicular(b - a);
    else
        return across(b - a, absolute((b - a)[0]) < absolute((b - a)[1]) ? Vector::axis(0) : Vector::axis(1));
}
template <int D, class Real> Vec<D, Real> left_of(const Vec<D, Real>& a, const Vec<D, Real>& b) {
    return direction(side_of(a, b));
}

} // namespace sinew::detail

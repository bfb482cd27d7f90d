#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/surface_point.h"

#include <string_view>

namespace sinew::collide {

/// Half-space dot(normal, x) <= offset: a floor or a wall without end.
template <int D, class Real> struct HalfSpace {
    static constexpr std::string_view name = "half_space";
    Vec<D, Real> normal = Vec<D, Real>::axis(1); ///< unit length, towards the free side
    Real offset = 0;

    SurfacePoint<D, Real> nearest(const Vec<D, Real>& point) const {
        const Real distance = dot(normal, point) - offset;
        return {point - normal * distance, normal, distance, 0};
    }
    static constexpr bool is_face(std::uint32_t) { return true; }
    template <class T> HalfSpace<D, T> as() const { return {cast<T>(normal), T(offset)}; }
    BoundingBox<D, Real> bounds(const Pose<D, Real>&) const { return BoundingBox<D, Real>::everything(); }
};

} // namespace sinew::collide

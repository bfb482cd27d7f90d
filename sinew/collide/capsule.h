#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/segment.h"
#include "sinew/collide/surface_point.h"

#include <string_view>

namespace sinew::collide {

/// Points within a radius of the segment a-b.
template <int D, class Real> struct Capsule {
    static constexpr std::string_view name = "capsule";
    Vec<D, Real> a{}, b{};
    Real radius = 1;

    SurfacePoint<D, Real> nearest(const Vec<D, Real>& point) const {
        const Real t = nearest_parameter(a, b, point);
        const auto center = a + (b - a) * t;
        auto surface = sharp_point(center, point, side(), t == Real(0) ? 0U : t == Real(1) ? 2U : 1U);
        surface.point += surface.normal * radius;
        surface.distance -= radius;
        return surface;
    }
    template <class T> Capsule<D, T> as() const { return {cast<T>(a), cast<T>(b), T(radius)}; }
    BoundingBox<D, Real> bounds(const Pose<D, Real>& pose) const {
        BoundingBox<D, Real> box;
        box.include(pose.to_world(a));
        box.include(pose.to_world(b));
        return box.grown(radius);
    }

  private:
    /// Some direction across the axis, for points on the axis.
    Vec<D, Real> side() const {
        const auto along = direction(b - a);
        const int i = D > 2 && absolute(along[1]) > Real(0.8) ? 2 : absolute(along[1]) > Real(0.8) ? 0 : 1;
        const auto axis = Vec<D, Real>::axis(i);
        return direction(axis - along * dot(axis, along));
    }
};

} // namespace sinew::collide

#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/surface_point.h"

#include <string_view>

namespace sinew::collide {

/// Sphere about the origin of its pose; a circle in the plane.
template <int D, class Real> struct Sphere {
    static constexpr std::string_view name = "sphere";
    Real radius = 1;

    SurfacePoint<D, Real> nearest(const Vec<D, Real>& point) const {
        auto surface = sharp_point(Vec<D, Real>{}, point, Vec<D, Real>::axis(1), 0);
        surface.point = surface.normal * radius;
        surface.distance -= radius;
        return surface;
    }
    template <class T> Sphere<D, T> as() const { return {T(radius)}; }
    BoundingBox<D, Real> bounds(const Pose<D, Real>& pose) const {
        BoundingBox<D, Real> box;
        box.include(pose.position);
        return box.grown(radius);
    }
};

} // namespace sinew::collide

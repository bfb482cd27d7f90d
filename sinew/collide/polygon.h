#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/segment.h"
#include "sinew/collide/surface_point.h"

#include <span>
#include <string_view>
#include <vector>

namespace sinew::collide {

/// Convex polygon, corners counter-clockwise in a y-up frame. Features: 2 i for the edge from corner i, 2 i + 1 for
/// corner i.
template <int D, class Real> struct Polygon {
    static_assert(D == 2);
    static constexpr std::string_view name = "polygon";
    using Vector = Vec<2, Real>;
    std::vector<Vector> corners;

    SurfacePoint<2, Real> nearest(const Vector& point) const {
        SurfacePoint<2, Real> inside, outside;
        inside.distance = -std::numeric_limits<Real>::max();
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            const auto face = nearest_line(point, i);
            if (face.distance > inside.distance) inside = face;
            const auto edge = nearest_edge(point, i);
            if (edge.distance < outside.distance) outside = edge;
        }
        return inside.distance <= Real(0) ? inside : outside;
    }
    BoundingBox<2, Real> bounds(const Pose<2, Real>& pose) const {
        BoundingBox<2, Real> box;
        for (const auto& corner : corners) box.include(pose.to_world(corner));
        return box;
    }

  private:
    const Vector& next(std::uint32_t i) const { return corners[i + 1 < corners.size() ? i + 1 : 0]; }
    Vector normal(std::uint32_t i) const { return -direction(perpendicular(next(i) - corners[i])); }

    SurfacePoint<2, Real> nearest_line(const Vector& point, std::uint32_t i) const {
        const auto n = normal(i);
        const Real distance = dot(n, point - corners[i]);
        return {point - n * distance, n, distance, 2 * i};
    }
    SurfacePoint<2, Real> nearest_edge(const Vector& point, std::uint32_t i) const {
        const Real t = nearest_parameter(corners[i], next(i), point);
        const std::uint32_t corner = 2 * (t == Real(0) ? i : (i + 1) % std::uint32_t(corners.size())) + 1;
        const bool is_corner = t == Real(0) || t == Real(1);
        auto surface =
            sharp_point(corners[i] + (next(i) - corners[i]) * t, point, normal(i), is_corner ? corner : 2 * i);
        if (!is_corner) surface.normal = normal(i); // free of the rounding error of a short difference
        return surface;
    }
};

/// True for at least three corners, counter-clockwise, convex, without a corner that is straight or doubled.
template <class Real> bool is_convex(std::span<const Vec<2, Real>> corners) {
    const std::size_t n = corners.size();
    if (n < 3) return false;
    Real turns = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const auto a = corners[i], b = corners[(i + 1) % n], c = corners[(i + 2) % n];
        if (!(cross(b - a, c - b) > Real(0))) return false;
        turns += cross(a - corners[0], b - corners[0]);
        for (std::size_t k = 0; k < n; ++k) // a star turns left at every corner, too
            if (k != i && k != (i + 1) % n && !(cross(b - a, corners[k] - a) > Real(0))) return false;
    }
    return turns > Real(0);
}

} // namespace sinew::collide

#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/segment.h"
#include "sinew/collide/segment_over_face.h"
#include "sinew/collide/surface_point.h"

#include <optional>
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

    /// Polygons have no copy in another precision: points may have any.
    template <class T> const Polygon& as() const { return *this; }

    template <class T> SurfacePoint<2, T> nearest(const Vec<2, T>& point) const {
        SurfacePoint<2, T> inside, outside;
        inside.distance = -std::numeric_limits<T>::max();
        for (std::uint32_t i = 0; i < corners.size(); ++i) {
            const auto face = nearest_line(point, i);
            if (face.distance > inside.distance) inside = face;
            const auto edge = nearest_edge(point, i);
            if (edge.distance < outside.distance) outside = edge;
        }
        return inside.distance <= T(0) ? inside : outside;
    }
    static constexpr bool is_face(std::uint32_t feature) { return feature % 2 == 0; }
    /// Calls visit(surface) with the points nearest to a point inside on the line of each edge.
    template <class T, class Visit> void each_face(const Vec<2, T>& inside, Visit&& visit) const {
        for (std::uint32_t i = 0; i < corners.size(); ++i) visit(nearest_line(inside, i));
    }
    /// Part of a segment above the edge that looks most along a direction; nothing above a corner.
    std::optional<SegmentOverFace<2, Real>> over_face(const Vector& a, const Vector& b, const Vector& along) const {
        std::uint32_t face = 0;
        for (std::uint32_t i = 1; i < corners.size(); ++i)
            if (dot(normal<Real>(i), along) > dot(normal<Real>(face), along)) face = i;
        const auto n = normal<Real>(face), from = corner<Real>(face), to = corner<Real>(face + 1);
        if (dot(n, along) < SegmentOverFace<2, Real>::least_slope) return std::nullopt;
        SegmentOverFace<2, Real> over{n, dot(n, from)};
        over.clip(dot(a - from, to - from), dot(b - from, to - from));
        over.clip(dot(to - a, to - from), dot(to - b, to - from));
        return over;
    }
    BoundingBox<2, Real> bounds(const Pose<2, Real>& pose) const {
        BoundingBox<2, Real> box;
        for (const auto& corner : corners) box.include(pose.to_world(corner));
        return box;
    }

  private:
    template <class T> Vec<2, T> corner(std::size_t i) const { return cast<T>(corners[i < corners.size() ? i : 0]); }
    template <class T> Vec<2, T> normal(std::size_t i) const {
        return -direction(perpendicular(corner<T>(i + 1) - corner<T>(i)));
    }

    template <class T> SurfacePoint<2, T> nearest_line(const Vec<2, T>& point, std::uint32_t i) const {
        const auto n = normal<T>(i);
        const T distance = dot(n, point - corner<T>(i));
        return {point - n * distance, n, distance, 2 * i};
    }
    template <class T> SurfacePoint<2, T> nearest_edge(const Vec<2, T>& point, std::uint32_t i) const {
        const auto a = corner<T>(i), b = corner<T>(i + 1);
        const T t = nearest_parameter(a, b, point);
        const std::uint32_t end = 2 * (t == T(0) ? i : (i + 1) % std::uint32_t(corners.size())) + 1;
        const bool is_corner = t == T(0) || t == T(1);
        auto surface = sharp_point(a + (b - a) * t, point, normal<T>(i), is_corner ? end : 2 * i);
        if (!is_corner) surface.normal = normal<T>(i); // free of the rounding error of a short difference
        return surface;
    }
};

/// True for at least three corners, counter-clockwise, convex, without a corner that is straight or doubled. A star
/// turns left at every corner, too, but more than once around: its edges turn from below to above the horizontal
/// several times.
template <class Real> bool is_convex(std::span<const Vec<2, Real>> corners) {
    const std::size_t n = corners.size();
    const auto edge = [&](std::size_t i) { return corners[(i + 1) % n] - corners[i % n]; };
    const auto rises = [](const Vec<2, Real>& e) { return e[1] > Real(0) || (e[1] == Real(0) && e[0] > Real(0)); };
    std::size_t rounds = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (!(cross(edge(i), edge(i + 1)) > Real(0))) return false;
        rounds += !rises(edge(i)) && rises(edge(i + 1));
    }
    return n >= 3 && rounds == 1;
}

} // namespace sinew::collide

#pragma once

#include "sinew/collide/segment.h"
#include "sinew/collide/surface_point.h"

#include <array>

namespace sinew::collide {

/// Triangle of a surface in space, solid behind it: its corners are counter-clockwise seen from the free side.
template <class Real> struct Triangle {
    using Vector = Vec<3, Real>;
    Vector a{}, b{}, c{};
    std::uint32_t number = 0; ///< index of the triangle in its surface

    template <class T> Triangle<T> as() const { return {cast<T>(a), cast<T>(b), cast<T>(c), number}; }
    Vector normal() const { return direction(cross(b - a, c - a)); }

    SurfacePoint<3, Real> nearest(const Vector& point) const {
        const auto n = normal();
        const auto face = point - n * dot(n, point - a);
        const bool in_ab = dot(n, cross(b - a, face - a)) >= Real(0), in_bc = dot(n, cross(c - b, face - b)) >= Real(0),
                   in_ca = dot(n, cross(a - c, face - c)) >= Real(0);
        if (in_ab && in_bc && in_ca) return {face, n, dot(n, point - a), number};
        auto best = nearest_edge(a, b, point, n);
        for (const auto& edge : {nearest_edge(b, c, point, n), nearest_edge(c, a, point, n)})
            if (edge.distance < best.distance) best = edge;
        return best;
    }

    std::array<Vector, 3> corners() const { return {a, b, c}; }
    /// Directions of the two edges along which the triangle ends at a point of its rim.
    std::array<Vector, 2> sides_at(const Vector& point, Real rounding) const {
        const std::array<Vector, 4> around{a, b, c, a};
        for (std::size_t i = 0; i < 3; ++i)
            if (norm(around[i] - point) <= rounding)
                return {direction(around[i + 1] - around[i]), direction(around[i == 0 ? 2 : i - 1] - around[i])};
        std::size_t nearest = 0;
        std::array<Real, 3> far{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto &p = around[i], &q = around[i + 1];
            far[i] = norm(point - p - (q - p) * nearest_parameter(p, q, point));
            if (far[i] < far[nearest]) nearest = i;
        }
        const auto along = direction(around[nearest + 1] - around[nearest]);
        return {along, -along};
    }
    /// True for contacts that are not on an edge.
    bool is_inside(const SurfacePoint<3, Real>& surface) const { return surface.normal == normal(); }
    /// False for contacts from behind.
    bool owns(const SurfacePoint<3, Real>& surface) const { return dot(surface.normal, normal()) >= Real(0); }

  private:
    SurfacePoint<3, Real> nearest_edge(const Vector& p, const Vector& q, const Vector& point, const Vector& n) const {
        return sharp_point(p + (q - p) * nearest_parameter(p, q, point), point, n, number);
    }
};

} // namespace sinew::collide

#pragma once

#include "sinew/collide/segment.h"
#include "sinew/collide/surface_point.h"

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

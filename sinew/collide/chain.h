#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/pose.h"
#include "sinew/collide/segment.h"
#include "sinew/collide/surface_point.h"

#include <array>
#include <string_view>
#include <vector>

namespace sinew::collide {

/// Edge of a chain, solid on its right side. Corners belong to the edge that ends there.
template <class Real> struct ChainEdge {
    using Vector = Vec<2, Real>;
    Vector a{}, b{};
    Vector after{};           ///< end of the next edge
    std::uint32_t number = 0; ///< index of the edge in its chain
    bool is_first = false;    ///< the chain begins at a
    bool is_last = false;     ///< the chain ends at b

    template <class T> ChainEdge<T> as() const {
        return {cast<T>(a), cast<T>(b), cast<T>(after), number, is_first, is_last};
    }
    Vector normal() const { return direction(perpendicular(b - a)); }

    /// Features: 3 number for the edge, one more for its beginning, two more for its end.
    SurfacePoint<2, Real> nearest(const Vector& point) const {
        const Real t = nearest_parameter(a, b, point);
        const auto n = normal();
        const std::uint32_t end = t == Real(0) ? 1 : t == Real(1) ? 2 : 0;
        auto surface = sharp_point(end == 2 ? b : a + (b - a) * t, point, n, 3 * number + end);
        if (end != 0) return surface;
        surface.normal = n;
        surface.distance = dot(n, point - a);
        return surface;
    }

    std::array<Vector, 2> corners() const { return {a, b}; }
    /// True for contacts that are not at an end.
    bool is_inside(const SurfacePoint<2, Real>& surface) const { return surface.feature % 3 == 0; }

    /// False for a contact that is another edge's: a corner counts for the edge that ends there, and only for
    /// directions between the normals of both its edges. Rolling over a flat corner is then smooth.
    bool owns(const SurfacePoint<2, Real>& surface) const {
        const auto end = surface.feature % 3;
        const Real along = dot(surface.normal, b - a);
        if (end == 0) return true;
        if (end == 1) return is_first && along <= Real(0);
        return along >= Real(0) && (is_last || dot(surface.normal, after - b) <= Real(0));
    }
};

/// Segments one after the other, solid on the right side of their direction: terrain, from left to right in a y-up
/// frame.
template <int D, class Real> struct Chain {
    static_assert(D == 2);
    static constexpr std::string_view name = "chain";
    using Part = ChainEdge<Real>;
    std::vector<Vec<2, Real>> points;
    bool is_closed = false; ///< an edge joins the last point to the first

    BoundingBox<2, Real> bounds(const Pose<2, Real>& pose) const {
        BoundingBox<2, Real> box;
        for (const auto& point : points) box.include(pose.to_world(point));
        return box;
    }

    template <class Visit> void parts_near(const BoundingBox<2, Real>& near, Visit&& visit) const {
        const std::size_t n = points.size(), edges = n < 2 ? 0 : is_closed ? n : n - 1;
        for (std::size_t i = 0; i < edges; ++i) {
            const Part edge{points[i],        points[(i + 1) % n],  points[(i + 2) % n],
                            std::uint32_t(i), !is_closed && i == 0, !is_closed && i + 1 == edges};
            BoundingBox<2, Real> box;
            box.include(edge.a);
            box.include(edge.b);
            if (box.grown(share_behind<Real> * norm(edge.b - edge.a)).overlaps(near)) visit(edge);
        }
    }
};

} // namespace sinew::collide

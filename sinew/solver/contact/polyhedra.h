#pragma once

#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/segment_normals.h"

#include <limits>

/// Convex solids in space. Two overlapping ones part along the axis of least overlap: across a face of either,
/// or across an edge of both (separating axes; Gottschalk et al. 1996).
namespace sinew::detail {

template <class Real> struct SolidAxis {
    Real separation = -std::numeric_limits<Real>::infinity();
    Vec3<Real> direction{}; ///< from the first solid to the second
};

template <class Real> class Polyhedra {
  public:
    using Vector = Vec3<Real>;
    using Face = PolyhedronRoom::Face;
    static constexpr auto none = PolyhedronRoom::none;

    Polyhedra(const SweepState<3, Real>& state, const ContactRoom<3, Real>& room)
        : state_(state), room_(room), list_(room.polyhedra) {}

    Vector place(std::uint32_t number) const { return state_.position_at(room_.particles[number].slot); }
    Vector normal(const Face& face) const {
        const auto a = place(face[0]);
        return normal_of(cross(place(face[1]) - a, place(face[2]) - a), Vector::axis(1));
    }
    /// Distance of a point beyond a face; negative inside.
    Real beyond(const Face& face, const Vector& x) const { return dot(normal(face), x - place(face[0])); }
    /// Shares of the corners of a face in the projection of a point.
    Vector shares(const Face& face, const Vector& x) const {
        const auto a = place(face[0]), b = place(face[1]), c = place(face[2]);
        const auto area = cross(b - a, c - a);
        const Real per = inverse_or_zero(dot(area, area));
        const Real at_b = dot(cross(x - a, c - a), area) * per, at_c = dot(cross(b - a, x - a), area) * per;
        return {{Real(1) - at_b - at_c, at_b, at_c}};
    }
    std::span<const Face> faces_of(const SolidParts& solid) const {
        return std::span(list_.faces).subspan(solid.first_face, solid.faces);
    }
    std::span<const std::uint32_t> corners_of(const SolidParts& solid) const {
        return std::span(list_.corners).subspan(solid.first_corner, solid.corners);
    }
    bool contains(const SolidParts& solid, const Vector& x, Real slack) const {
        return std::ranges::all_of(faces_of(solid), [&](const Face& face) { return beyond(face, x) <= slack; });
    }
    std::uint32_t solid_of(std::uint32_t particle) const {
        return list_.solids.empty() ? none : list_.solid_of[particle];
    }

    /// True if a direction points away from the faces on both sides of an edge.
    bool points_out(const SolidEdge& edge, const Vector& away) const {
        constexpr Real slight = Real(1e-3);
        const auto a = place(edge.a);
        return std::ranges::all_of(edge.opposite, [&](std::uint32_t corner) {
            const auto inward = place(corner) - a;
            return dot(away, inward) <= slight * norm(away) * norm(inward);
        });
    }
    /// Direction across two edges, away from the first solid; zero for nearly parallel ones, and where others are
    /// nearer.
    Vector axis(const SolidEdge& one, const SolidEdge& other) const {
        auto across = crossing(one, place(other.b) - place(other.a));
        return points_out(one, across) && points_out(other, -across) ? across : Vector{};
    }
    /// Unit vector across an edge and a line, away from the solid; zero for nearly parallel ones.
    Vector crossing(const SolidEdge& edge, const Vector& line) const {
        constexpr Real least_sine = Real(0.05);
        const auto a = place(edge.a), along = place(edge.b) - a, across = cross(along, line);
        const Real size = norm(across);
        if (!(size > least_sine * norm(along) * norm(line))) return {};
        const auto inward = (place(edge.opposite[0]) - a) + (place(edge.opposite[1]) - a);
        return across * (dot(across, inward) > Real(0) ? Real(-1) / size : Real(1) / size);
    }

    /// Distance of the deepest corner of a solid beyond a face of another.
    Real separation(const Face& face, const SolidParts& solid) const {
        const auto n = normal(face), a = place(face[0]);
        Real least = std::numeric_limits<Real>::infinity();
        for (const auto corner : corners_of(solid)) least = min(least, dot(n, place(corner) - a));
        return least;
    }
    /// Largest coordinate of a solid along a direction.
    Real reach(const SolidParts& solid, const Vector& along) const {
        Real most = -std::numeric_limits<Real>::infinity();
        for (const auto corner : corners_of(solid)) most = max(most, dot(along, place(corner)));
        return most;
    }
    /// Axis of the largest separation of two solids, towards the second; negative for an overlap.
    SolidAxis<Real> parting(const SolidParts& a, const SolidParts& b) const {
        SolidAxis<Real> best;
        const auto try_axis = [&](Real separation, const Vector& direction) {
            if (separation > best.separation) best = {separation, direction};
        };
        for (const auto& face : faces_of(a)) try_axis(separation(face, b), normal(face));
        for (const auto& face : faces_of(b)) try_axis(separation(face, a), -normal(face));
        if (best.separation >= Real(0)) return best;
        for (auto i = a.first_edge; i < a.first_edge + a.edges; ++i)
            for (auto k = b.first_edge; k < b.first_edge + b.edges; ++k) {
                const auto &one = list_.edges[i], &other = list_.edges[k];
                const auto n = axis(one, other);
                if (n != Vector{}) try_axis(-reach(a, n) - reach(b, -n), n);
            }
        return best;
    }

  private:
    const SweepState<3, Real>& state_;
    const ContactRoom<3, Real>& room_;
    const PolyhedronRoom& list_;
};

} // namespace sinew::detail

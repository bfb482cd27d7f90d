#pragma once

#include "sinew/solver/contact/polyhedra.h"
#include "sinew/solver/contact/row_members.h"

namespace sinew::detail {

/// Rows of contact with solids in space: of particles with faces, and of lines with edges, on the outer side of both.
template <int D, class Real> class SolidRows : protected RowMembers<D, Real> {
    using Base = RowMembers<D, Real>;

  protected:
    using Base::Base;
    using Base::finish, Base::set_thickness, Base::slack_of, Base::take;
    using Base::state_, Base::room_, Base::list_, Base::source_, Base::number_of;
    using typename Base::ContactRowT;
    using typename Base::Origin;
    using typename Base::Particle;
    using Vector = Vec<D, Real>;

    /// True for particles of two overlapping solids, which part along one axis, and for one inside the solid of the
    /// other: the way out is through a face, not away from a corner.
    bool are_of_nested(const Particle& a, const Particle& b) {
        if constexpr (D == 3) {
            const auto one = polyhedra_.solid_of(number_of(a)), other = polyhedra_.solid_of(number_of(b));
            return parting(one, other).separation < Real(0) || is_inside(a, other) || is_inside(b, one);
        }
        return false;
    }
    /// True if an edge is nearer to a point than the faces beside it are; `away`: from the edge's point t to the point.
    bool is_around_edge(const Particle& p, const ContactSegment& s, const Vector& x, const Vector& away, Real t) {
        if constexpr (D == 3) {
            if (s.edge == none) return true;
            const auto& edge = room_.polyhedra.edges[s.edge];
            if (parting(polyhedra_.solid_of(number_of(p)), edge.solid).separation < Real(0)) return false;
            if (t > Real(0) && t < Real(1)) return polyhedra_.points_out(edge, away);
            return !polyhedra_.contains(room_.polyhedra.solids[edge.solid], x, Real(0));
        }
        return true;
    }
    /// Normal and distance of two segments of which one at least is the edge of a solid; false unless both touch from
    /// outside, along the axis by which overlapping solids part. `away`: from t to s.
    bool find_axis(const ContactSegment& s, const ContactSegment& t, const Vector& away, Vector& normal, Real& distance,
                   Real thickness) {
        if constexpr (D == 3) {
            const auto* const one = edge_at(s);
            const auto* const other = edge_at(t);
            auto across = one ? -polyhedra_.crossing(*one, line_of(t)) : polyhedra_.crossing(*other, line_of(s));
            if (across == Vector{}) across = normal; // side by side
            if ((one && !polyhedra_.points_out(*one, -across)) || (other && !polyhedra_.points_out(*other, across)))
                return false;
            normal = across, distance = dot(across, away);
            if (!one || !other) return distance > -thickness;
            const auto best = parting(one->solid, other->solid);
            return best.separation >= Real(0) ? distance >= Real(0) : dot(best.direction, across) < -aligned;
        }
        return false;
    }
    /// Row of a particle and the nearest face of a solid, or the one reached first.
    bool add_on_face(const Particle& p, const SolidParts& solid) {
        if constexpr (D == 3) {
            const Real thickness = p.radius + radius_of(solid);
            const auto x = state_.position_at(p.slot);
            const auto entry = entry_of(p, solid, x, thickness);
            if (!entry) return false;
            const auto at = place_on(solid, *entry, x);
            if (!at) return false;
            const auto& [face, shares] = *at;
            ContactRowT row;
            Origin origin;
            row.normal = polyhedra_.normal(*face);
            row.gap = polyhedra_.beyond(*face, x) - thickness;
            set_thickness(origin, thickness);
            origin.deep = max(origin.deep, depth_of(index_of(solid)));
            const std::array<const Particle*, 3> corners{&room_.particles[(*face)[0]], &room_.particles[(*face)[1]],
                                                         &room_.particles[(*face)[2]]};
            take(row, p, corners, shares);
            return finish(row, origin, p, *corners[0]);
        }
        return false;
    }

    /// Depth from which two segments are held as the figures answer: edges have a side, whatever the radius.
    Real depth_at(const ContactSegment& s, const ContactSegment& t) const {
        Real depth = 0;
        if constexpr (D == 3)
            for (const auto* edge : {edge_at(s), edge_at(t)})
                if (edge) depth = max(depth, depth_of(edge->solid));
        return depth;
    }

  private:
    Real depth_of(std::uint32_t solid) const {
        constexpr double share = 0.05;
        return Real(share * room_.polyhedra.half_width[solid]);
    }
    using Face = PolyhedronRoom::Face;
    struct Nothing {
        Nothing(const SweepState<D, Real>&, const ContactRoom<D, Real>&) {}
    };
    std::conditional_t<D == 3, Polyhedra<Real>, Nothing> polyhedra_{state_, room_};
    static constexpr auto none = PolyhedronRoom::none;
    static constexpr Real aligned = Real(0.98); ///< cosine of the angle between an axis and a row along the axis

    /// Axes of the last pairs looked at.
    struct Parting {
        std::uint32_t a = none, b = none;
        SolidAxis<Real> axis;
    };
    std::array<Parting, 8> partings_{};

    /// Axis of two solids, from the first; without an overlap where one is `none`.
    SolidAxis<Real> parting(std::uint32_t first, std::uint32_t second) {
        if (first == none || second == none || first == second) return {.separation = 0};
        const auto a = std::min(first, second), b = std::max(first, second);
        auto& known = partings_[(a + 3 * b) % partings_.size()];
        if (known.a != a || known.b != b)
            known = {a, b, polyhedra_.parting(room_.polyhedra.solids[a], room_.polyhedra.solids[b])};
        auto axis = known.axis;
        if (first != a) axis.direction = -axis.direction;
        return axis;
    }
    std::uint32_t index_of(const SolidParts& solid) const {
        return std::uint32_t(&solid - room_.polyhedra.solids.data());
    }
    bool is_inside(const Particle& p, std::uint32_t solid) const {
        return solid != none &&
               polyhedra_.contains(room_.polyhedra.solids[solid], state_.position_at(p.slot), slack_of(p.radius));
    }
    struct Entry {
        const Face* face = nullptr;
        Real distance = 0;
        Vector by{}; ///< displacement relative to the face, until the particle reaches the face
    };

    const SolidEdge* edge_at(const ContactSegment& s) const {
        return s.edge == none ? nullptr : &room_.polyhedra.edges[s.edge];
    }
    Vector line_of(const ContactSegment& s) const {
        return polyhedra_.place(s.number_b) - polyhedra_.place(s.number_a);
    }
    Real radius_of(const SolidParts& solid) const {
        Real radius = std::numeric_limits<Real>::max();
        for (const auto corner : polyhedra_.corners_of(solid)) radius = min(radius, room_.particles[corner].radius);
        return radius;
    }
    Vector displacement_of(const Face& face) const {
        Vector sum{};
        for (const auto corner : face) sum += state_.displacement_at(room_.particles[corner].slot);
        return sum * (Real(1) / Real(3));
    }
    /// The nearest face of a point outside; of a fast one, the last of the planes passed on the way in. Inside, the
    /// face of the way out.
    std::optional<Entry> entry_of(const Particle& p, const SolidParts& solid, const Vector& x, Real thickness) {
        Entry nearest{.distance = -std::numeric_limits<Real>::infinity()};
        for (const auto& face : polyhedra_.faces_of(solid))
            if (const Real distance = polyhedra_.beyond(face, x); distance > nearest.distance)
                nearest = {.face = &face, .distance = distance};
        if (!(nearest.distance > thickness))
            if (const auto axis = axis_towards(p, solid); axis.separation < Real(0)) return way_out(solid, x, axis);
        if (nearest.distance < Real(0)) return nearest;
        const auto moved = state_.displacement_at(p.slot);
        if (!(norm(moved - displacement_of(*nearest.face)) > Real(0.5) * thickness)) return nearest;
        Real last = 0;
        Entry entry = nearest;
        for (const auto& face : polyhedra_.faces_of(solid)) {
            const Real distance = polyhedra_.beyond(face, x) - thickness;
            if (!(distance > Real(0))) continue;
            const auto by = moved - displacement_of(face);
            const Real speed = -dot(polyhedra_.normal(face), by);
            if (!(speed > Real(0))) return std::nullopt;
            const Real time = distance / speed;
            if (time > Real(2)) return std::nullopt;
            if (time >= last) last = time, entry = {&face, distance + thickness, by * time};
        }
        return entry;
    }
    SolidAxis<Real> axis_towards(const Particle& p, const SolidParts& solid) {
        return parting(index_of(solid), polyhedra_.solid_of(number_of(p)));
    }
    /// The face across the axis of two overlapping solids, for a corner behind this face.
    std::optional<Entry> way_out(const SolidParts& solid, const Vector& x, const SolidAxis<Real>& axis) const {
        Real most = aligned;
        Entry entry;
        for (const auto& face : polyhedra_.faces_of(solid))
            if (const Real along = dot(polyhedra_.normal(face), axis.direction); along > most)
                most = along, entry.face = &face;
        if (entry.face) entry.distance = polyhedra_.beyond(*entry.face, x);
        return entry.distance < Real(0) ? std::optional(entry) : std::nullopt;
    }
    /// The triangle below a point, in the plane of the entry's, and the shares of the corners; nothing beside the
    /// plane's triangles.
    std::optional<std::pair<const Face*, Vector>> place_on(const SolidParts& solid, const Entry& entry,
                                                           const Vector& x) const {
        constexpr Real level = Real(1e-3);
        const Real beside = entry.distance < Real(0) ? Real(-0.05) : Real(-1e-5);
        const auto at = x + entry.by, normal = polyhedra_.normal(*entry.face);
        const Face* found = nullptr;
        Vector shares{};
        Real most = -std::numeric_limits<Real>::infinity();
        for (const auto& face : polyhedra_.faces_of(solid)) {
            if (dot(polyhedra_.normal(face), normal) < Real(1) - level) continue;
            const auto here = polyhedra_.shares(face, at);
            const Real least = min(min(here[0], here[1]), here[2]);
            if (least > most) most = least, found = &face, shares = here;
        }
        if (!found || most < beside) return std::nullopt;
        return std::pair{found, shares};
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/math/limit.h"
#include "sinew/solver/contact/row_nodes.h"
#include "sinew/solver/contact/softness.h"

namespace sinew::detail {

/// Rows of contact solved one after the other, each exactly or as a soft spring.
template <int D, class Real> class RowSolver {
  public:
    using Vector = Vec<D, Real>;
    using RowT = ContactRow<D, Real>;

    /// `furthest`: bound on the components of a displacement. `motions`: of the clusters, for
    /// `solve`; without, `change` looks at particles.
    RowSolver(SweepState<D, Real>& state, Real furthest, const ClusterMotions<D, Real>& motions = {})
        : state_(state), furthest_(furthest), motions_(motions) {}

    Real furthest() const { return furthest_; }
    void apply(const RowT& row, const Vector& impulse) const { particles(row).push(impulse); }
    /// Gives the multiplier of friction once more, and turns what it rubs.
    void apply_again(const RowT& row) const {
        apply(row, row.normal * row.multiplier + row.tangent);
        turn(row, row.tangent);
    }
    /// Part of a relative displacement along the surface, with that of the rims of balls.
    Vector slip_of(const RowT& row, const Vector& moved) const {
        auto slip = moved - row.normal * dot(row.normal, moved);
        if (row.arm > Real(0))
            each_ball(row, [&](Row slot) { slip += slip_of_rim(state_.rollers[slot].rim, row.normal) * row.arm; });
        return slip;
    }
    /// Mass that friction feels: without turns it would be `mass`.
    Real mass_with_turns(const RowT& row, Real mass) const {
        if (!(row.arm > Real(0)) || mass == Real(0)) return mass;
        Real response = Real(1) / mass;
        each_ball(row, [&](Row slot) { response += state_.rim_mobility(slot) * square(row.arm); });
        return Real(1) / response;
    }
    /// Turns balls by an impulse of friction.
    void turn(const RowT& row, const Vector& impulse) const {
        if (!(row.arm > Real(0))) return;
        const auto by = turn_of_rim(row.normal, impulse);
        each_ball(row, [&](Row slot) {
            auto& rim = state_.rollers[slot].rim;
            rim = clamp_components(rim + by * (state_.rim_mobility(slot) * row.arm), furthest_);
        });
    }
    /// True for a member that is touched itself, as a ball is; ends of links share a contact between them.
    static bool is_ball(const RowT& row, std::size_t i) {
        return row.weight[i] == Real(1) || row.weight[i] == Real(-1);
    }
    Vector relative_displacement(const RowT& row) const {
        if (row.acts_on_clusters && motions_.list) return clusters(row).displacement();
        return particles(row).displacement();
    }
    /// Change of the gap in the substep; `surface`: displacement of a wall.
    Real change(const RowT& row, const Vector& surface = {}) const {
        return dot(row.normal, relative_displacement(row) - surface);
    }

    /// Adds an impulse to the row, along the normal and of friction.
    void add(RowT& row, const Vector& impulse) const {
        if (row.acts_on_clusters)
            add(row, clusters(row), impulse);
        else
            add(row, particles(row), impulse);
    }
    template <class Nodes> void add(RowT& row, const Nodes& nodes, const Vector& impulse) const {
        const Real along = dot(row.normal, impulse);
        const auto across = impulse - row.normal * along;
        nodes.push(impulse);
        turn(row, across);
        row.multiplier += along;
        row.tangent += across;
    }
    void solve(RowT& row, const Softness<Real>& soft, const Vector& surface = {}) const {
        if (row.acts_on_clusters)
            solve(row, clusters(row), soft, surface);
        else
            solve(row, particles(row), soft, surface);
    }
    /// As the nodes answer (row_nodes.h).
    template <class Nodes>
    void solve(RowT& row, const Nodes& nodes, const Softness<Real>& soft, const Vector& surface) const {
        const auto moved = nodes.displacement() - surface;
        const Real along = dot(row.normal, moved);
        const Real next = min(one_sided_multiplier(row.multiplier, nodes.mass_along(row.normal), along, row.gap, soft),
                              limit::multiplier<Real>);
        const auto slip = slip_of(row, moved);
        auto tangent = row.tangent - slip * mass_with_turns(row, nodes.mass_along(direction(slip)));
        const Real square_size = dot(tangent, tangent), max_friction = row.friction * next;
        if (square_size > square(max_friction)) tangent *= max_friction * inverse_or_zero(square_root(square_size));
        row.max = max(row.max, next);
        if (next == row.multiplier && tangent == row.tangent) return;
        nodes.push(row.normal * (next - row.multiplier) + (tangent - row.tangent));
        turn(row, tangent - row.tangent);
        row.multiplier = next;
        row.tangent = tangent;
    }
    /// From the other side to the side of the normal.
    Vector centre_line(const RowT& row) const {
        Vector line{};
        const auto first = state_.position_at(row.slot[0]);
        for (std::size_t i = 1; i < std::size_t(row.members); ++i)
            line += (state_.position_at(row.slot[i]) - first) * row.weight[i];
        return line;
    }
    bool is_central(const RowT& row) const {
        constexpr auto slight = Real(1e-3);
        const auto line = centre_line(row);
        const Real along = dot(line, row.normal);
        return along != Real(0) && dot(line, line) - square(along) <= square(slight * along);
    }
    /// Levers at the present places.
    void take_levers(RowT& row) const {
        if constexpr (D == 3)
            if (row.is_on_face && row.levers > 1 && row.lever[0].a == 1) take_levers_of_face(row);
        for (std::size_t k = 0; k < std::size_t(row.levers); ++k) {
            auto& lever = row.lever[k];
            if (row.is_on_face && lever.a == 1) continue;
            const auto edge = state_.position_at(row.slot[lever.b]) - state_.position_at(row.slot[lever.a]);
            lever.along = edge * -(lever.radius * row.arm * inverse_or_zero(dot(edge, edge)));
        }
    }
    /// Turns the normals between figures with the lines of centres, after the move: an impulse along such a line has no
    /// moment, which one along the normal from before the move has.
    void follow_centres(ContactPart<D, Real>& part) const {
        for (std::size_t i = 0; i < part.first_wall; ++i) {
            auto& row = part.rows[i];
            if constexpr (D == 3)
                if (row.is_on_face) follow_face(row);
            if (!row.is_central || row.is_on_face) continue;
            const auto line = centre_line(row);
            const Real distance = norm(line), along = dot(line, row.normal);
            const auto normal = line * (along < Real(0) ? -inverse_or_zero(distance) : inverse_or_zero(distance));
            if (normal == Vector{}) continue;
            row.normal = normal;
            if (row.arm > Real(0)) row.arm = part.origins[i].arm_at(distance);
            take_levers(row);
            row.tangent -= normal * dot(normal, row.tangent);
        }
    }
    /// Calls visit(row, origin, displacement of its wall) for all rows of a part.
    template <class Visit> static void each(ContactPart<D, Real>& part, Visit&& visit) {
        for (std::size_t i = 0; i < part.rows.size(); ++i) {
            const auto& origin = part.origins[i];
            visit(part.rows[i], origin, origin.surface_displacement);
        }
    }

  private:
    SweepState<D, Real>& state_;
    Real furthest_;
    ClusterMotions<D, Real> motions_;

    ParticleNodes<D, Real> particles(const RowT& row) const { return {state_, row, furthest_}; }
    ClusterNodes<D, Real> clusters(const RowT& row) const { return {state_, motions_, row, furthest_}; }

    /// Motion of a corner along the normal turns the face by the gradient of the corner's share.
    void take_levers_of_face(RowT& row) const {
        const auto a = state_.position_at(row.slot[1]);
        const auto b = state_.position_at(row.slot[2]) - a, c = state_.position_at(row.slot[3]) - a;
        const auto area = cross(b, c);
        const Real per = row.lever[0].radius * row.arm * inverse_or_zero(dot(area, area));
        row.lever[0].along = cross(area, c) * per, row.lever[1].along = cross(b, area) * per;
    }
    /// The face at its present place, and the point nearest to the particle.
    void follow_face(RowT& row) const {
        const auto a = state_.position_at(row.slot[1]), x = state_.position_at(row.slot[0]) - a;
        const auto b = state_.position_at(row.slot[2]) - a, c = state_.position_at(row.slot[3]) - a;
        const auto area = cross(b, c);
        const Real per = inverse_or_zero(dot(area, area));
        if (per == Real(0)) return;
        row.normal = area * square_root(per);
        row.weight[2] = -dot(cross(x, c), area) * per, row.weight[3] = -dot(cross(b, x), area) * per;
        row.weight[1] = Real(-1) - row.weight[2] - row.weight[3];
        Real response = 0;
        for (std::size_t i = 0; i < std::size_t(row.members); ++i)
            response += square(row.weight[i]) * state_.mobility[row.slot[i]];
        row.mass = inverse_or_zero(response);
        take_levers(row);
        row.tangent -= row.normal * dot(row.normal, row.tangent);
    }

    template <class Visit> void each_ball(const RowT& row, const Visit& visit) const {
        for (std::size_t i = 0; i < std::size_t(row.members); ++i)
            if (is_ball(row, i) && state_.rolls(row.slot[i])) visit(row.slot[i]);
    }
};

} // namespace sinew::detail

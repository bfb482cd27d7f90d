#pragma once

#include "sinew/math/limit.h"
#include "sinew/solver/contact/contact_row.h"
#include "sinew/solver/contact/softness.h"
#include "sinew/solver/sweep_state.h"

namespace sinew::detail {

/// Rows of contact solved one after the other, each exactly or as a soft spring.
template <int D, class Real> class RowSolver {
  public:
    using Vector = Vec<D, Real>;
    using RowT = ContactRow<D, Real>;

    /// `furthest`: bound on the components of a displacement.
    RowSolver(SweepState<D, Real>& state, Real furthest) : state_(state), furthest_(furthest) {}

    void apply(const RowT& row, const Vector& impulse) const {
        for (std::size_t i = 0; i < row.slot.size(); ++i) {
            const Real mobility = state_.mobility[row.slot[i]];
            if (mobility == Real(0)) continue; // another part may read an immovable particle
            const auto moved = state_.displacement_at(row.slot[i]) + impulse * (row.weight[i] * mobility);
            state_.set_displacement(row.slot[i], clamp_components(moved, furthest_));
        }
    }
    Vector relative_displacement(const RowT& row) const {
        auto sum = state_.displacement_at(row.slot[0]) * row.weight[0];
        for (std::size_t i = 1; i < row.slot.size(); ++i) sum += state_.displacement_at(row.slot[i]) * row.weight[i];
        return sum;
    }
    /// Change of the gap in the substep; `surface`: displacement of a wall.
    Real change(const RowT& row, const Vector& surface = {}) const {
        return dot(row.normal, relative_displacement(row) - surface);
    }

    void solve(RowT& row, const Softness<Real>& soft, const Vector& surface = {}) const {
        const auto moved = relative_displacement(row) - surface;
        const Real along = dot(row.normal, moved);
        const Real next =
            min(one_sided_multiplier(row.multiplier, row.mass, along, row.gap, soft), limit::multiplier<Real>);
        const auto slip = moved - row.normal * along;
        auto tangent = row.tangent - slip * row.mass;
        const Real square_size = dot(tangent, tangent), max_friction = row.friction * next;
        if (square_size > square(max_friction)) tangent *= max_friction * inverse_or_zero(square_root(square_size));
        row.max = max(row.max, next);
        if (next == row.multiplier && tangent == row.tangent) return;
        apply(row, row.normal * (next - row.multiplier) + (tangent - row.tangent));
        row.multiplier = next;
        row.tangent = tangent;
    }
    /// All rows of a part.
    void solve(ContactPart<D, Real>& part, const Softness<Real>& kept, const Softness<Real>& others) const {
        each(part, [&](RowT& row, const Vector& surface) { solve(row, row.keeps ? kept : others, surface); });
    }

    /// Calls visit(row, displacement of its wall) for all rows of a part.
    template <class Visit> static void each(ContactPart<D, Real>& part, Visit&& visit) {
        for (std::size_t i = 0; i < part.first_wall; ++i) visit(part.rows[i], Vector{});
        for (auto i = part.first_wall; i < part.rows.size(); ++i)
            visit(part.rows[i], part.origins[i].surface_displacement);
    }

  private:
    SweepState<D, Real>& state_;
    Real furthest_;
};

} // namespace sinew::detail

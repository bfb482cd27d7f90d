#pragma once

#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/contact/held_rows.h"
#include "sinew/solver/solver.h"

namespace sinew::detail {

/// Deep rows of contact, solved as whole figures answer with their links held. A soft row of a light limb gives way
/// where whole figures are pressed against each other or a wall; beyond half of the radii it is held.
template <int D, class Real> class DeepRows {
  public:
    using RowT = ContactRow<D, Real>;
    using Origin = ContactOrigin<D, Real>;
    using Part = ContactPart<D, Real>;

    /// `h`: length of the substep.
    DeepRows(Solver<D, Real>& solver, const RowSolver<D, Real>& rows, Real h)
        : solver_(solver), state_(solver.sweep_state), rows_(rows), held_(solver.contacts.get(), state_, rows), h_(h),
          gravity_(norm(state_.gravity)) {}

    /// Before the lengths are corrected. Rows that begin the substep no deeper than half of that are left to the next
    /// one.
    void hold() {
        constexpr int rounds = 3;
        const auto& parts = solver_.contacts->parts.list;
        if (std::ranges::all_of(parts, [](const Part& part) { return part.deep.empty(); })) return;
        for (int i = 0; i < rounds; ++i)
            if (!hold_each()) break;
    }

    /// Links of a taut rope give way across it to first order and not to second: the correction of its lengths brings
    /// back what a row has moved. Rows of figures are therefore held as the figures answer at the end of the
    /// displacements, where such a rope is bent, until lengths and rows agree.
    void hold_again() {
        constexpr int corrections = 8, rounds = 3;
        for (int i = 0; i < corrections; ++i) {
            if (!each_lacking([&](RowT& row, Origin&, Real) { mark(row); })) return;
            projector().turn_marked(state_);
            for (int k = 0; k < rounds; ++k)
                if (!each_lacking([&](RowT& row, Origin& origin, Real lacking) { move(row, origin, lacking); })) break;
            projector().project_lengths_again(state_);
        }
    }

  private:
    Solver<D, Real>& solver_;
    SweepState<D, Real>& state_;
    const RowSolver<D, Real>& rows_;
    HeldRows<D, Real> held_;
    Real h_, gravity_;

    auto& projector() { return solver_.contacts->projector; }

    /// One round over all rows; true if any has moved.
    bool hold_each() {
        bool any = false;
        for (auto& part : solver_.contacts->parts.list)
            for (const auto i : part.deep)
                if (i < part.first_wall || !solver_.contacts->is_buried_at(part.rows[i].slot[0]))
                    any = hold(part.rows[i], part.origins[i]) || any;
        return any;
    }
    /// Calls visit(row, origin, distance) for rows of figures that lack more than is of any use; true if there are any.
    template <class Visit> bool each_lacking(const Visit& visit) {
        constexpr Real slight = Real(1e-3); // of the depth; a substep recovers 25 times that share of what is beyond
        bool any = false;
        for (auto& part : solver_.contacts->parts.list)
            for (const auto i : part.deep) {
                auto& origin = part.origins[i];
                const Real lacking = missing(part.rows[i], origin);
                if (i >= part.first_wall || !(lacking > slight * origin.deep)) continue;
                visit(part.rows[i], origin, lacking);
                any = true;
            }
        return any;
    }
    void mark(const RowT& row) {
        for (const Row slot : HeldRows<D, Real>::members_of(row)) projector().mark(slot);
    }
    void move(RowT& row, Origin& origin, Real lacking) {
        mark(row);
        const Real impulse = held_.move(row, lacking);
        origin.pushed += impulse;
        row.max = max(row.max, row.multiplier + impulse);
    }
    Real missing(const RowT& row, const Origin& origin) const {
        const Real beyond = -row.gap - origin.deep;
        return (beyond > Real(0) ? recovery(beyond) : beyond) - rows_.change(row, origin.surface_displacement);
    }
    /// Way out of a depth in a substep: of the soft rows, and no faster than anything leaves an overlap, since the
    /// velocity of this way stays.
    Real recovery(Real depth) const {
        return min(Softness<Real>::contact().rate * depth, depth - depth_left(depth, gravity_, h_));
    }
    bool hold(RowT& row, Origin& origin) {
        const Real lacking = missing(row, origin);
        if (!(lacking > Real(0))) return false;
        const Real impulse = min(lacking * held_.mass_of(row), limit::multiplier<Real>);
        held_.push(row, impulse);
        origin.pushed += impulse;
        row.max = max(row.max, row.multiplier + impulse);
        return impulse > Real(0);
    }
};

} // namespace sinew::detail

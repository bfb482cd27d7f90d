#pragma once

#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/contact/delassus.h"
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
        : solver_(solver), state_(solver.sweep_state), rows_(rows), h_(h), gravity_(norm(state_.gravity)) {}

    /// Before the lengths are corrected. Rows that begin the substep no deeper than half of that are left to the next
    /// one.
    void hold() {
        constexpr int rounds = 3;
        const auto& parts = solver_.contacts->parts.list;
        if (std::ranges::all_of(parts, [](const Part& part) { return part.deep.empty(); })) return;
        Delassus<D, Real> figures(*solver_.contacts, state_, rows_);
        figures.begin([&](const auto& add) { each_exposed([&](RowT& row, Origin&) { add(row); }); });
        for (int i = 0; i < rounds; ++i)
            if (!hold_each(figures)) break;
        figures.finish();
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
    Real h_, gravity_;

    auto& projector() { return solver_.contacts->projector; }

    /// Calls visit(row, origin) for all rows but those of a buried figure and a wall.
    template <class Visit> void each_exposed(const Visit& visit) {
        for (auto& part : solver_.contacts->parts.list)
            for (const auto i : part.deep)
                if (i < part.first_wall || !solver_.contacts->is_buried_at(part.rows[i].slot[0]))
                    visit(part.rows[i], part.origins[i]);
    }
    /// One round over all rows; true if any has moved.
    bool hold_each(Delassus<D, Real>& figures) {
        bool any = false;
        std::size_t number = 0;
        each_exposed([&](RowT& row, Origin& origin) {
            const DelassusNodes<D, Real> nodes{figures, number++};
            const Real lacking =
                missing(row, origin, dot(row.normal, nodes.displacement() - origin.surface_displacement));
            if (!(lacking > Real(0))) return;
            const Real impulse = min(lacking * nodes.mass_along(row.normal), limit::multiplier<Real>);
            nodes.push(row.normal * impulse);
            note(row, origin, impulse);
            any = any || impulse > Real(0);
        });
        return any;
    }
    /// Calls visit(row, origin, distance) for rows of figures that lack more than is of any use; true if there are any.
    template <class Visit> bool each_lacking(const Visit& visit) {
        constexpr Real slight = Real(1e-3); // of the depth; a substep recovers 25 times that share of what is beyond
        bool any = false;
        for (auto& part : solver_.contacts->parts.list)
            for (const auto i : part.deep) {
                auto& origin = part.origins[i];
                const Real lacking =
                    missing(part.rows[i], origin, rows_.change(part.rows[i], origin.surface_displacement));
                if (i >= part.first_wall || !(lacking > slight * origin.deep)) continue;
                visit(part.rows[i], origin, lacking);
                any = true;
            }
        return any;
    }
    void mark(const RowT& row) {
        for (const Row slot : row.slots()) projector().mark(slot);
    }
    /// Moves a contact by a distance along its normal, as far as the figures can.
    void move(RowT& row, Origin& origin, Real distance) {
        mark(row);
        std::array<Vec<D, double>, RowT::most> along{};
        for (std::size_t i = 0; i < row.members; ++i) along[i] = cast<double>(row.normal) * double(row.weight[i]);
        const auto pushes = std::span<const Vec<D, double>>(along).first(row.members);
        const auto response = projector().response(state_);
        const double mass = inverse_or_zero(response.along(row.slots(), pushes));
        const double impulse = min(double(distance) * mass, double(limit::multiplier<Real>));
        response.move(state_, row.slots(), pushes, impulse);
        note(row, origin, Real(impulse));
    }
    static void note(RowT& row, Origin& origin, Real impulse) {
        origin.pushed += impulse;
        row.max = max(row.max, row.multiplier + impulse);
    }
    /// `change`: of the gap in the substep.
    Real missing(const RowT& row, const Origin& origin, Real change) const {
        const Real beyond = -row.gap - origin.deep;
        return (beyond > Real(0) ? recovery(beyond) : beyond) - change;
    }
    /// Way out of a depth in a substep: of the soft rows, and no faster than anything leaves an overlap, since the
    /// velocity of this way stays.
    Real recovery(Real depth) const {
        return min(Softness<Real>::contact().rate * depth, depth - depth_left(depth, gravity_, h_));
    }
};

} // namespace sinew::detail

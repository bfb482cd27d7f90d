#pragma once

#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/row_solver.h"

namespace sinew::detail {

/// Rows of contact as whole figures answer, with their links held.
template <int D, class Real> class HeldRows {
  public:
    using RowT = ContactRow<D, Real>;

    HeldRows(ContactRoom<D, Real>& room, SweepState<D, Real>& state, const RowSolver<D, Real>& rows)
        : projector_(room.projector), state_(state), rows_(rows) {}

    /// 1 / (displacement of the contact for a unit impulse), kg.
    Real mass_of(const RowT& row) const {
        std::array<Vec<D, double>, D + 1> push_of{};
        const auto members = std::size_t(row.members);
        for (std::size_t i = 0; i < members; ++i) push_of[i] = cast<double>(row.normal * row.weight[i]);
        return Real(
            inverse_or_zero(projector_.response(state_).along(members_of(row), std::span(push_of).first(members))));
    }
    /// Pushes along the normal, and then holds the links of each figure.
    void push(const RowT& row, Real impulse) const {
        rows_.apply(row, row.normal * impulse);
        const auto slots = members_of(row);
        const auto& component_of = projector_.links().component_of;
        for (std::size_t i = 0; i < slots.size(); ++i) {
            const auto is_same = [&](Row slot) { return component_of[slot] == component_of[slots[i]]; };
            if (std::ranges::none_of(slots.first(i), is_same)) projector_.project_velocities(state_, slots[i]);
        }
    }
    static std::span<const Row> members_of(const RowT& row) {
        return std::span(row.slot).first(std::size_t(row.members));
    }

  private:
    LinkProjector<D, Real>& projector_;
    SweepState<D, Real>& state_;
    const RowSolver<D, Real>& rows_;
};

} // namespace sinew::detail

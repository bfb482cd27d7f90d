#pragma once

#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/row_solver.h"

namespace sinew::detail {

/// Rows of contact as whole figures answer, with their links held.
template <int D, class Real> class HeldRows {
  public:
    using RowT = ContactRow<D, Real>;

    /// Without a room, which a world without contacts does not have, there are no rows either.
    HeldRows(ContactRoom<D, Real>* room, SweepState<D, Real>& state, const RowSolver<D, Real>& rows)
        : room_(room), state_(state), rows_(rows) {}

    /// 1 / (displacement of the contact for a unit impulse), kg.
    Real mass_of(const RowT& row) const {
        const auto pushes = pushes_of(row);
        return Real(inverse_or_zero(projector().response(state_).along(members_of(row), of_members(row, pushes))));
    }
    /// Moves the contact by a distance along the normal, as far as the figures can; returns the impulse.
    Real move(const RowT& row, Real distance) const {
        const auto pushes = pushes_of(row);
        const auto slots = members_of(row);
        const auto response = projector().response(state_);
        const double mass = inverse_or_zero(response.along(slots, of_members(row, pushes)));
        const double impulse = min(double(distance) * mass, double(limit::multiplier<Real>));
        response.move(state_, slots, of_members(row, pushes), impulse);
        return Real(impulse);
    }
    /// Pushes along the normal, and then holds the links of each figure.
    void push(const RowT& row, Real impulse) const {
        rows_.apply(row, row.normal * impulse);
        const auto slots = members_of(row);
        const auto& component_of = projector().links().component_of;
        for (std::size_t i = 0; i < slots.size(); ++i) {
            const auto is_same = [&](Row slot) { return component_of[slot] == component_of[slots[i]]; };
            if (std::ranges::none_of(slots.first(i), is_same)) projector().project_velocities(state_, slots[i]);
        }
    }
    static std::span<const Row> members_of(const RowT& row) {
        return std::span(row.slot).first(std::size_t(row.members));
    }

  private:
    LinkProjector<D, Real>& projector() const { return room_->projector; }

    using Pushes = std::array<Vec<D, double>, D + 1>;
    static Pushes pushes_of(const RowT& row) {
        Pushes pushes{};
        for (std::size_t i = 0; i < std::size_t(row.members); ++i) pushes[i] = cast<double>(row.normal * row.weight[i]);
        return pushes;
    }
    static std::span<const Vec<D, double>> of_members(const RowT& row, const Pushes& pushes) {
        return std::span(pushes).first(std::size_t(row.members));
    }
    ContactRoom<D, Real>* room_;
    SweepState<D, Real>& state_;
    const RowSolver<D, Real>& rows_;
};

} // namespace sinew::detail

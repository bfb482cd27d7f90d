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
    /// Displacement of the contact for an impulse, a symmetric matrix; 1 / kg.
    Matrix<D, Real> response_of(const RowT& row) const {
        Matrix<D, Real> matrix;
        std::array<double, D + 1> weights{};
        for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = double(row.weight[i]);
        for (int i = 0; i < D; ++i) {
            const auto pushes = pushes_of(row, Vec<D, double>::axis(i));
            matrix.column[std::size_t(i)] = cast<Real>(
                projector().response(state_).displacement(members_of(row), of_members(row, pushes), weights));
        }
        return matrix;
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
    void push(const RowT& row, Real impulse) const { push(row, row.normal * impulse); }
    void push(const RowT& row, const Vec<D, Real>& impulse) const {
        rows_.apply(row, impulse);
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
    static Pushes pushes_of(const RowT& row) { return pushes_of(row, cast<double>(row.normal)); }
    static Pushes pushes_of(const RowT& row, const Vec<D, double>& direction) {
        Pushes pushes{};
        for (std::size_t i = 0; i < std::size_t(row.members); ++i) pushes[i] = direction * double(row.weight[i]);
        return pushes;
    }
    static std::span<const Vec<D, double>> of_members(const RowT& row, const Pushes& pushes) {
        return std::span(pushes).first(std::size_t(row.members));
    }
    ContactRoom<D, Real>* room_;
    SweepState<D, Real>& state_;
    const RowSolver<D, Real>& rows_;
};

/// Whole figures as what a row acts on (row_nodes.h).
template <int D, class Real> class HeldNodes {
  public:
    using Vector = Vec<D, Real>;
    using RowT = ContactRow<D, Real>;

    /// Ropes let go and take hold from push to push, so the response is that of now.
    HeldNodes(const HeldRows<D, Real>& held, const RowSolver<D, Real>& rows, const RowT& row)
        : held_(held), rows_(rows), row_(row), response_(held.response_of(row)) {}

    Vector displacement() const { return rows_.relative_displacement(row_); }
    Real mass_along(const Vector& direction) const { return inverse_or_zero(dot(direction, response_ * direction)); }
    void push(const Vector& impulse) const { held_.push(row_, impulse); }

  private:
    const HeldRows<D, Real>& held_;
    const RowSolver<D, Real>& rows_;
    const RowT& row_;
    Matrix<D, Real> response_; ///< displacement of the contact for an impulse, 1 / kg
};

} // namespace sinew::detail

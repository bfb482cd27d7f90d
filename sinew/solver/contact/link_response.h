#pragma once

#include "sinew/math/matrix.h"
#include "sinew/solver/contact/link_factor.h"

namespace sinew::detail {

/// Displacements of particles for impulses on them, with the lengths of their components held.
template <int D, class Real> class LinkResponse {
  public:
    using Vector = Vec<D, double>;
    using Matrix = sinew::Matrix<D, double>;

    /// `right`: room, per link.
    LinkResponse(const RigidLinks<D, Real>& links, const LinkFactor<D>& factor, std::span<double> right,
                 const SweepState<D, Real>& state)
        : links_(links), factor_(factor), right_(right), state_(state) {}

    /// Displacement of a particle for an impulse on it: a symmetric matrix, 1 / kg.
    Matrix of(Row slot) const {
        auto matrix = Matrix::diagonal(double(state_.mobility[slot]));
        if (links_.component_of[slot] == none) return matrix;
        const auto& component = links_.components[links_.component_of[slot]];
        for (int i = 0; i < D; ++i) {
            each(component, [&](const auto& link, double& right) { right = pull(link, slot) * link.along[i]; });
            factor_.solve(links_.list, component, right_);
            each(component, [&](const auto& link, double& right) {
                matrix.column[std::size_t(i)] += link.along * (-pull(link, slot) * right);
            });
        }
        return matrix;
    }
    /// Displacement, along the pushes, for a unit of these pushes on particles, 1 / kg.
    double along(std::span<const Row> slots, std::span<const Vector> pushes) const {
        double sum = 0;
        for (std::size_t i = 0; i < slots.size(); ++i) {
            sum += double(state_.mobility[slots[i]]) * dot(pushes[i], pushes[i]);
            const auto component = links_.component_of[slots[i]];
            const auto earlier = slots.first(i);
            const bool is_new = std::none_of(earlier.begin(), earlier.end(),
                                             [&](Row slot) { return links_.component_of[slot] == component; });
            if (component != none && is_new) sum -= held_back(links_.components[component], slots, pushes);
        }
        return max(sum, 0.0);
    }

  private:
    using Link = RigidLink<D>;
    static constexpr auto none = RigidLinks<D, Real>::none;
    const RigidLinks<D, Real>& links_;
    const LinkFactor<D>& factor_;
    std::span<double> right_;
    const SweepState<D, Real>& state_;

    template <class Visit> void each(const LinkComponent& component, Visit&& visit) const {
        for (auto k = component.first_link; k < component.last_link; ++k) visit(links_.list[k], right_[k]);
    }
    /// Change of a link's length for a unit displacement of a particle along it, times the inverse mass.
    static double pull(const Link& link, Row slot) {
        return (link.b == slot ? link.weight_b : 0) - (link.a == slot ? link.weight_a : 0);
    }
    /// Share of the displacement which the links of a component take back.
    double held_back(const LinkComponent& component, std::span<const Row> slots, std::span<const Vector> pushes) const {
        const auto change = [&](const Link& link) {
            double sum = 0;
            for (std::size_t i = 0; i < slots.size(); ++i)
                if (const double weight = pull(link, slots[i]); weight != 0) sum += weight * dot(link.along, pushes[i]);
            return link.is_active ? sum : 0;
        };
        each(component, [&](const auto& link, double& right) { right = change(link); });
        factor_.solve(links_.list, component, right_);
        double sum = 0;
        each(component, [&](const auto& link, double& right) { sum += change(link) * right; });
        return sum;
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/solver/contact/rigid_links.h"

#include <algorithm>
#include <span>
#include <vector>

namespace sinew::detail {

/// Factorisation L D L^T of G M^-1 G^T, with G the gradients of the lengths of a component's links, within the skyline.
template <int D> class LinkFactor {
  public:
    using Link = RigidLink<D>;

    template <class Links> void resize(const Links& links) {
        entries_.resize(links.entries);
        pivots_.resize(links.list.size());
    }

    void factorise(std::span<const Link> list, const LinkComponent& component) {
        for (auto k = component.first_link; k < component.last_link; ++k) factorise_row(list, k);
    }

    /// Replaces the right side by the solution.
    void solve(std::span<const Link> list, const LinkComponent& component, std::span<double> right) const {
        const auto begin = component.first_link, end = component.last_link;
        for (auto k = begin; k < end; ++k) {
            const double* const row = entries_.data() + list[k].start;
            const double* const above = right.data() + list[k].first;
            const auto size = k - list[k].first;
            double sum = right[k];
            for (std::uint32_t m = 0; m < size; ++m) sum -= row[m] * above[m];
            right[k] = sum;
        }
        for (auto k = begin; k < end; ++k) right[k] *= pivots_[k];
        for (auto k = end; k-- > begin;) {
            const double* const row = entries_.data() + list[k].start;
            double* const above = right.data() + list[k].first;
            const auto size = k - list[k].first;
            const double own = right[k];
            for (std::uint32_t m = 0; m < size; ++m) above[m] -= row[m] * own;
        }
    }

  private:
    std::vector<double> entries_; ///< strict lower triangle, by rows
    std::vector<double> pivots_;  ///< 1 / pivot

    static double coupling(const Link& k, const Link& m) {
        if (!k.is_active || !m.is_active) return 0;
        double sum = 0;
        if (k.a == m.a) sum += k.weight_a;
        if (k.b == m.b) sum += k.weight_b;
        if (k.a == m.b) sum -= k.weight_a;
        if (k.b == m.a) sum -= k.weight_b;
        return sum == 0 ? 0 : sum * dot(k.along, m.along);
    }

    /// The diagonal is raised by a little: redundant links share their load.
    void factorise_row(std::span<const Link> list, std::uint32_t k) {
        constexpr double softness = 1e-7;
        const auto& link = list[k];
        double* const row = entries_.data() + link.start;
        double pivot = (link.weight_a + link.weight_b) * (1 + softness);
        for (auto m = link.first; m < k; ++m) {
            const auto& other = list[m];
            const double* const above = entries_.data() + other.start;
            double sum = coupling(link, other);
            for (auto j = std::max(link.first, other.first); j < m; ++j)
                sum -= row[j - link.first] * above[j - other.first];
            row[m - link.first] = sum; // times the pivot, for now
        }
        for (auto m = link.first; m < k; ++m) {
            const double scaled = row[m - link.first] * pivots_[m];
            pivot -= row[m - link.first] * scaled;
            row[m - link.first] = scaled;
        }
        pivots_[k] = link.is_active ? inverse_or_zero(max(pivot, 0.0)) : 0;
    }
};

} // namespace sinew::detail

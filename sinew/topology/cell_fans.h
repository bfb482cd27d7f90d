#pragma once

#include "sinew/table/id.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace sinew {

/// Adjacency by distances: the neighbours of each row, sorted and unique.
class Neighbours {
  public:
    Neighbours(std::size_t particles, std::span<const std::array<Row, 2>> links)
        : first_(particles + 1, 0), row_(2 * links.size()) {
        for (const auto& ends : links)
            for (const Row end : ends) ++first_[end + 1];
        for (std::size_t i = 0; i < particles; ++i) first_[i + 1] += first_[i];
        auto next = first_;
        for (const auto& [a, b] : links) row_[next[a]++] = b, row_[next[b]++] = a;
        std::size_t kept = 0;
        for (Row row = 0; row < particles; ++row) {
            const auto begin = row_.begin() + std::ptrdiff_t(first_[row]),
                       end = row_.begin() + std::ptrdiff_t(next[row]);
            std::sort(begin, end);
            first_[row] = kept;
            kept = std::size_t(std::unique_copy(begin, end, row_.begin() + std::ptrdiff_t(kept)) - row_.begin());
        }
        first_[particles] = kept;
    }

    std::span<const Row> of(Row row) const {
        return std::span(row_).subspan(first_[row], first_[row + 1] - first_[row]);
    }

  private:
    std::vector<std::size_t> first_;
    std::vector<Row> row_;
};

/// Fans of a particle: groups of neighbours connected by the cells around the particle. Two neighbours share a cell if
/// linked (a triangle), or if both are linked to a third particle (a quadrangle).
class Fans {
  public:
    /// Keeps a reference to `neighbours`.
    Fans(const Neighbours& neighbours, std::size_t particles)
        : neighbours_(neighbours), number_(particles, none), via_(particles, none) {}

    /// For each neighbour of `row`, in order: the first neighbour of the same fan.
    std::vector<Row> around(Row row) {
        const auto near = neighbours_.of(row);
        fan_.resize(near.size());
        for (std::size_t i = 0; i < near.size(); ++i) number_[near[i]] = fan_[i] = i;
        for (std::size_t i = 0; i < near.size(); ++i)
            for (const Row far : neighbours_.of(near[i])) {
                if (far == row) continue;
                if (number_[far] != none)
                    join(i, number_[far]);
                else if (via_[far] != none)
                    join(i, via_[far]);
                else
                    via_[far] = i;
            }
        std::vector<Row> firsts;
        for (std::size_t i = 0; i < near.size(); ++i) {
            firsts.push_back(near[first_of(i)]);
            number_[near[i]] = none;
            for (const Row far : neighbours_.of(near[i])) via_[far] = none;
        }
        return firsts;
    }

  private:
    static constexpr std::size_t none = ~std::size_t(0);

    std::size_t first_of(std::size_t i) const {
        while (fan_[i] != i) i = fan_[i];
        return i;
    }
    void join(std::size_t a, std::size_t b) {
        const auto first = std::min(first_of(a), first_of(b)), second = std::max(first_of(a), first_of(b));
        fan_[second] = first;
    }

    const Neighbours& neighbours_;
    std::vector<std::size_t> number_; // row -> index among the neighbours
    std::vector<std::size_t> via_;    // row further out -> index of the first neighbour linked to the row
    std::vector<std::size_t> fan_;    // disjoint-set forest of neighbour indices
};

} // namespace sinew

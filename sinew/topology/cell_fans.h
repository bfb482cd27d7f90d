#pragma once

#include "sinew/math/union_find.h"
#include "sinew/table/id.h"
#include "sinew/table/row_lists.h"

#include <array>
#include <span>
#include <vector>

namespace sinew {

/// Neighbours of each row by distances, in order and without repetition.
using Neighbours = RowLists<Row>;
inline Neighbours neighbours_of(std::size_t particles, std::span<const std::array<Row, 2>> links) {
    Neighbours lists;
    lists.fill(particles, [&](auto&& visit) {
        for (const auto& [a, b] : links) visit(a, b), visit(b, a);
    });
    lists.make_sets();
    return lists;
}

/// Fans of a particle: groups of neighbours connected by the cells around the particle. Two neighbours share a cell if
/// linked (a triangle), or if both are linked to a third particle (a quadrangle).
class Fans {
  public:
    /// Keeps a reference to `neighbours`.
    Fans(const Neighbours& neighbours, std::size_t particles)
        : neighbours_(neighbours), number_(particles, none), via_(particles, none) {}

    /// For each neighbour of `row`, in order: the first neighbour of the same fan.
    std::vector<Row> around(Row row) {
        const auto near = neighbours_[row];
        fan_.reset(near.size());
        for (std::uint32_t i = 0; i < near.size(); ++i) number_[near[i]] = i;
        for (std::uint32_t i = 0; i < near.size(); ++i)
            for (const Row far : neighbours_[near[i]]) {
                if (far == row) continue;
                if (number_[far] != none)
                    fan_.join(i, number_[far]);
                else if (via_[far] != none)
                    fan_.join(i, via_[far]);
                else
                    via_[far] = i;
            }
        std::vector<Row> firsts;
        for (std::uint32_t i = 0; i < near.size(); ++i) {
            firsts.push_back(near[fan_.first_of(i)]);
            number_[near[i]] = none;
            for (const Row far : neighbours_[near[i]]) via_[far] = none;
        }
        return firsts;
    }

  private:
    static constexpr auto none = ~std::uint32_t(0);

    const Neighbours& neighbours_;
    std::vector<std::uint32_t> number_; // row -> index among the neighbours
    std::vector<std::uint32_t> via_;    // row further out -> index of the first neighbour linked to the row
    UnionFind fan_;                     // of indices among the neighbours
};

} // namespace sinew

#pragma once

#include "sinew/solver/block.h"

#include <algorithm>
#include <array>

/// Flat squares of a block in 3D: four nodes in a plane, all six distances between them rigid, such as a trunk with
/// both diagonals. The sixth length follows from five, so a stress is left undetermined; and no length resists leaving
/// the plane, to first order, while every such motion is forbidden. Newton's method has no tangent to go along. Five
/// lengths and the volume zero of the tetrahedron say the same, and are independent.
namespace sinew::detail {

template <int D> class FlatSquares {
  public:
    FlatSquares(Blocks<D>& blocks, const Block& block)
        : blocks_(blocks), block_(block), first_entry_(blocks.first_entry[block.first_node]),
          sides_(blocks.room.sides) {}

    /// Replaces the longest distance of each square, a link of the block, by an angle row of volume zero at the end of
    /// all angle rows. Returns the number of squares.
    std::uint32_t run() requires(D == 3) {
        list_sides();
        const auto before = blocks_.bends.size();
        for (auto i = block_.first_node; i < block_.first_node + block_.unknowns; ++i) visit_neighbours(i);
        if (blocks_.bends.size() == before) return 0;
        auto link = block_.first_link;
        const auto first = blocks_.links.begin() + std::ptrdiff_t(link);
        blocks_.links.erase(
            std::remove_if(first, blocks_.links.end(), [&](const DistanceRow<D>&) { return is_replaced(link++); }),
            blocks_.links.end());
        return std::uint32_t(blocks_.bends.size() - before);
    }

  private:
    static constexpr double flat = 1e-6;    ///< difference from the length in the plane, relative: rounding of floats
    static constexpr double thinnest = 0.1; ///< height of a triangle over the longest distance

    Blocks<D>& blocks_;
    const Block& block_;
    std::uint32_t first_entry_;
    std::vector<SquareSide>& sides_; ///< by entry

    /// Nodes in a square: those on the edge that two triangles share, then the ends of the distance to replace.
    using Corners = std::array<std::uint32_t, 4>;

    std::uint32_t end_of_entries(std::uint32_t node) const {
        return node + 1 < blocks_.first_entry.size() ? blocks_.first_entry[node + 1]
                                                     : std::uint32_t(blocks_.entries.size());
    }
    SquareSide& side(std::uint32_t entry) const { return sides_[entry - first_entry_]; }
    const DistanceRow<D>& link_of(std::uint32_t entry) const { return blocks_.links[side(entry).link]; }
    double length(std::uint32_t entry) const { return link_of(entry).high; }

    void list_sides() {
        sides_.assign(blocks_.entries.size() - first_entry_, {Blocks<D>::none, false, false});
        for (auto i = block_.first_link; i < blocks_.links.size(); ++i) {
            const auto& link = blocks_.links[i];
            if (link.entry != Blocks<D>::none && link.low == link.high && !link.is_compliant())
                side(link.entry).link = i;
        }
    }
    bool is_replaced(std::uint32_t link) const {
        const auto entry = blocks_.links[link].entry;
        return entry != Blocks<D>::none && side(entry).is_replaced && side(entry).link == link;
    }

    /// Entry that couples two later neighbours of a node, given by their places among the node's entries.
    std::uint32_t entry_between(std::uint32_t node, std::uint32_t e, std::uint32_t g) const {
        const auto begin = blocks_.first_entry[node], all = end_of_entries(node) - begin;
        const auto i = e - begin, j = g - begin;
        return blocks_.pairs[blocks_.first_pair[node] + i * (2 * all - i - 1) / 2 + (j - i - 1)];
    }
    void visit_neighbours(std::uint32_t node) {
        const auto end = end_of_entries(node);
        for (auto e = blocks_.first_entry[node]; e < end; ++e)
            for (auto g = e + 1; g < end; ++g)
                for (auto h = g + 1; h < end; ++h)
                    visit({node, blocks_.entries[e].node, blocks_.entries[g].node, blocks_.entries[h].node},
                          {e, g, h, entry_between(node, e, g), entry_between(node, e, h), entry_between(node, g, h)});
    }

    /// Four nodes, and the entries that couple them: 0 1, 0 2, 0 3, 1 2, 1 3, 2 3. Two squares share one side at most.
    void visit(const Corners& nodes, const std::array<std::uint32_t, 6>& entries) {
        int taken = 0;
        for (const auto entry : entries) {
            if (side(entry).link == Blocks<D>::none || side(entry).is_replaced) return;
            taken += side(entry).is_taken;
        }
        const auto longest =
            std::max_element(entries.begin(), entries.end(), [&](auto a, auto b) { return length(a) < length(b); }) -
            entries.begin();
        if (taken > 1 || side(entries[std::size_t(longest)]).is_taken) return;
        constexpr std::array<std::array<std::size_t, 2>, 6> ends{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
        const auto [c, d] = ends[std::size_t(longest)];
        const auto [a, b] = ends[5 - std::size_t(longest)];
        const auto between = [&](std::size_t i, std::size_t j) {
            const auto pair = std::find(ends.begin(), ends.end(), std::array{std::min(i, j), std::max(i, j)});
            return length(entries[std::size_t(pair - ends.begin())]);
        };
        if (!is_flat(between(a, b), {between(a, c), between(b, c)}, {between(a, d), between(b, d)}, between(c, d)))
            return;
        for (const auto entry : entries) side(entry).is_taken = true;
        side(entries[std::size_t(longest)]).is_replaced = true;
        replace(entries, std::size_t(longest), nodes, between(0, 1) * between(0, 2) * between(0, 3) / 6);
    }

    /// True if the ends c and d of two triangles over the base a b, in one plane, are as far apart as `distance`. Sides
    /// of a triangle are given from a and from b.
    static bool is_flat(double base, std::array<double, 2> c, std::array<double, 2> d, double distance) {
        const auto position = [&](const std::array<double, 2>& sides) {
            const double along = (square(sides[0]) - square(sides[1]) + square(base)) / (2 * base);
            return std::array{along, square_root(max(square(sides[0]) - square(along), 0.0))};
        };
        const auto p = position(c), q = position(d);
        if (min(p[1], q[1]) < thinnest * distance) return false;
        for (const double height : {p[1] - q[1], p[1] + q[1]})
            if (absolute(square_root(square(p[0] - q[0]) + square(height)) - distance) <= flat * distance) return true;
        return false;
    }

    void replace(const std::array<std::uint32_t, 6>& entries, std::size_t longest, const Corners& nodes, double unit) {
        AngleRow<D> plane;
        const auto& link = link_of(entries[longest]);
        plane.constraint = link.constraint, plane.slot = link.slot;
        plane.replaces_link = true;
        plane.unit = unit;
        plane.arity = 4;
        plane.nodes = nodes;
        plane.entries = entries;
        blocks_.bends.push_back(plane);
    }
};

} // namespace sinew::detail

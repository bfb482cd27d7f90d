#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/batch/mesh_links.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace sinew::detail {

/// Sequences of links between consecutive slots of a mesh, each with a colour: sequences of a tile with hardly any
/// common particles share one.
template <int D, class Real> class SequenceFinder {
    using Links = MeshLinks<D, Real>;
    using Link = PlanRoom::Link;
    static constexpr auto max_colors = Links::max_colors;

  public:
    SequenceFinder(Solver<D, Real>& solver, Links& links, const ComponentFinder<D, Real>& parts)
        : plan_(solver.sweep_state.plan), room_(solver.sweep_state.room), links_(links), parts_(parts) {}

    /// Finds the sequences of a component whose tiles are the last of the plan, and lists the remaining links. Returns
    /// the number of colours.
    std::uint32_t find(std::size_t part) {
        sort_into_bands(part);
        find_sequences();
        return colors_;
    }

  private:
    static constexpr std::uint32_t min_in_sequence = 6; ///< shorter sequences are faster as scattered links

    Plan<Real>& plan_;
    PlanRoom& room_;
    Links& links_;
    const ComponentFinder<D, Real>& parts_;
    std::uint32_t colors_ = 0;
    std::array<std::uint32_t, max_colors> tile_spans_{}; ///< tile_span of each colour, in tiles

    std::uint32_t first_tile() const { return plan_.components.back().first_tile; }

    /// Sorts the links into tiles, by their lower end. `at` holds the end of each tile's range in `sorted`.
    void sort_into_bands(std::size_t part) {
        const auto tile_of = [&](Row link) {
            return plan_.tile_of(first_tile(), links_.at(link).lower) - first_tile();
        };
        auto& end = room_.at;
        end.assign(plan_.tiles.size() - first_tile() + 1, 0);
        for (const Row link : parts_.links(part)) ++end[tile_of(link) + 1];
        for (std::size_t tile = 1; tile < end.size(); ++tile) end[tile] += end[tile - 1];
        room_.sorted.resize(parts_.links(part).size());
        for (const Row link : parts_.links(part)) room_.sorted[end[tile_of(link)]++] = link;
        end.pop_back();
    }

    /// Sorts the links of each tile by slot difference and lower slot, and finds the sequences. By tile, for a large
    /// mesh has no memory to sort all links at once.
    void find_sequences() {
        auto& links = room_.of_tile;
        room_.sequences.clear();
        room_.left_over.clear();
        colors_ = 0;
        std::uint32_t first = 0;
        for (std::uint32_t tile = 0; tile < room_.at.size(); first = room_.at[tile++]) {
            const auto rows = std::span(room_.sorted).subspan(first, room_.at[tile] - first);
            links.clear();
            for (const Row row : rows) links.push_back(links_.at(row));
            sinew::sort(links.begin(), links.end());
            for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = links[i].row;
            find_in_tile(first_tile() + tile, first);
        }
    }

    /// Sequences of a tile, whose first link is number `begin` in `sorted`.
    void find_in_tile(std::uint32_t tile, std::uint32_t begin) {
        const auto& links = room_.of_tile;
        auto& left = room_.left_of_tile;
        left.clear();
        for (std::size_t i = 0, end; i < links.size(); i = end) {
            end = sequence_end(tile, i);
            const auto sequence = std::span(links).subspan(i, end - i);
            const auto color = sequence.size() < min_in_sequence ? max_colors : color_for(tile, sequence);
            if (color == max_colors) {
                left.insert(left.end(), sequence.begin(), sequence.end());
                continue;
            }
            links_.use(sequence, std::uint64_t(1) << color);
            colors_ = std::max(colors_, color + 1);
            room_.sequences.push_back({std::uint32_t(begin + i), std::uint32_t(begin + end), tile, color});
        }
        links_.clear(links);
        sinew::sort(left.begin(), left.end(), [](const Link& a, const Link& b) {
            return std::tuple(a.lower, a.offset, a.row) < std::tuple(b.lower, b.offset, b.row);
        });
        for (const auto& link : left) room_.left_over.push_back(link.row);
    }

    std::size_t sequence_end(std::uint32_t tile, std::size_t first) const {
        constexpr std::uint32_t max_lanes = 32; // in two packs
        const auto& links = room_.of_tile;
        const auto& begun = links[first];
        const auto max = begun.offset < max_lanes ? begun.offset : std::uint32_t(links.size());
        const auto into = plan_.tiles[plan_.tile_of(tile, Links::upper(begun))].last;
        auto end = first + 1;
        while (end < links.size() && end - first < max && links[end].offset == begun.offset &&
               links[end].lower == links[end - 1].lower + 1 && Links::upper(links[end]) < into)
            ++end;
        return end;
    }

    /// First colour of the same span which has hardly any of the sequence's particles yet. The span must be equal
    /// since a colour of span 0 adds no delay.
    std::uint32_t color_for(std::uint32_t tile, std::span<const Link> sequence) {
        constexpr std::size_t shared = 8; // at most one link of eight
        const auto tile_span = plan_.tile_of(tile, Links::upper(sequence.front())) - tile;
        for (std::uint32_t color = 0; color < colors_; ++color) {
            std::size_t taken = 0;
            for (const auto& link : sequence) taken += links_.used(link) >> color & 1;
            if (tile_spans_[color] == tile_span && taken * shared <= sequence.size()) return color;
        }
        if (colors_ < max_colors) tile_spans_[colors_] = tile_span;
        return colors_;
    }
};

} // namespace sinew::detail

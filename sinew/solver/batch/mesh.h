#pragma once

#include "sinew/solver/batch/batches.h"
#include "sinew/solver/batch/component_finder.h"
#include "sinew/solver/batch/link_sequences.h"

#include <algorithm>
#include <bit>

/// Layout of any mesh. Particles are ordered by level (level_structure.h). Sequences of links between consecutive slots
/// are batches, as in a cloth; sequences of a tile with hardly any common particles have the same colour. The remaining
/// links are coloured greedily: each gets the first colour unused at both ends.
namespace sinew::detail {

template <int D, class Real> class MeshBuilder {
  public:
    MeshBuilder(Solver<D, Real>& solver, ComponentFinder<D, Real>& parts, RunWriter<D, Real>& runs)
        : swept_(solver.sweep_state), plan_(solver.sweep_state.plan), room_(solver.sweep_state.room), parts_(parts),
          runs_(runs), links_(solver, parts), sequences_(solver, links_, parts) {}

    void lay_out(std::size_t part) {
        const auto begin = Row(swept_.row_of.size());
        lie_in_rows(part, begin);
        links_.begin(begin, parts_.members(part).size());
        const auto colors = sequences_.find(part);
        for (std::uint32_t color = 0; color < colors; ++color) add_sequences(color);
        colour();
    }

  private:
    using Links = MeshLinks<D, Real>;
    using Link = PlanRoom::Link;
    static constexpr auto max_colors = Links::max_colors;

    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    ComponentFinder<D, Real>& parts_;
    RunWriter<D, Real>& runs_;
    Links links_;
    SequenceFinder<D, Real> sequences_;

    std::uint32_t first_tile() const { return plan_.components.back().first_tile; }

    /// Slots of a level: every second particle, then the others, since neighbours share a link.
    void lie_in_rows(std::size_t part, Row begin) {
        const auto all = parts_.members(part);
        constexpr Row min_in_band = 128;
        parts_.list_neighbours(part);
        auto& levels = room_.levels;
        levels.find(room_.near);
        Row tile = begin;
        for (std::size_t i = 0; i < levels.size(); ++i) {
            for (std::size_t c = 0; c < 2; ++c)
                for (std::size_t k = c; k < levels[i].size(); k += 2) swept_.give_slot(all[levels[i][k]]);
            if (swept_.size() - tile < min_in_band && i + 1 < levels.size()) continue;
            plan_.tiles.push_back({tile, swept_.size()});
            tile = swept_.size();
        }
        parts_.forget_neighbours();
    }

    void add_sequences(std::uint32_t color) {
        std::size_t next = 0;
        add_family([&](std::uint32_t tile, auto&& note) {
            for (; next < room_.sequences.size(); ++next) {
                const auto& sequence = room_.sequences[next];
                if (sequence.tile != tile) break;
                if (sequence.color != color) continue;
                for (auto i = sequence.first; i < sequence.end; ++i) {
                    const auto link = links_.at(room_.sorted[i]);
                    runs_.add_listed(link.row, link.lower, Links::upper(link), i == sequence.first);
                    note(link);
                }
            }
        });
    }

    void colour() {
        const auto& left = room_.left_over;
        if (left.empty()) return;
        constexpr auto last_colour = max_colors; // links beyond the last colour are solved one by one
        std::uint32_t colours = 0;
        bool any_last = false;
        room_.colour.clear();
        for (const Row row : left) {
            const auto link = links_.at(row);
            const auto colour = std::min(std::uint32_t(std::countr_one(links_.used(link))), last_colour);
            room_.colour.push_back((unsigned char)(colour));
            if (colour == last_colour) {
                any_last = true;
                continue;
            }
            links_.use(std::span(&link, 1), std::uint64_t(1) << colour);
            colours = std::max(colours, colour + 1);
        }
        constexpr std::size_t few = 8; // less than one link of eight: a single colour, for less delay
        if (left.size() * few < room_.sorted.size()) return add_colours(0, any_last ? last_colour : colours - 1);
        for (std::uint32_t colour = 0; colour < colours; ++colour) add_colours(colour, colour);
        if (any_last) add_colours(last_colour, last_colour);
    }

    /// Merges greedy colours [first, last] into one colour of the plan, ordered by tile and then by greedy colour.
    void add_colours(std::uint32_t first, std::uint32_t last) {
        const auto& left = room_.left_over;
        std::size_t begin = 0, end = 0;
        add_family([&](std::uint32_t tile, auto&& note) {
            const auto behind = plan_.tiles[tile].last;
            for (begin = end; end < left.size() && links_.at(left[end]).lower < behind;) ++end;
            for (auto colour = first; colour <= last; ++colour) {
                runs_.break_run();
                for (auto i = begin; i < end; ++i) {
                    if (room_.colour[i] != colour) continue;
                    const auto link = links_.at(left[i]);
                    if (colour == max_colors)
                        runs_.begin_run(link.row, link.lower, Links::upper(link));
                    else
                        runs_.add_scattered(link.row, link.lower, Links::upper(link));
                    note(link);
                }
            }
        });
    }

    /// Adds a colour to the plan. Calls add(tile, note) for each tile; `add` passes every link to `note`.
    template <class Add> void add_family(Add&& add) {
        runs_.begin_family();
        std::uint32_t tile_span = 0;
        for (auto tile = first_tile(); tile < plan_.tiles.size(); ++tile) {
            runs_.begin_band();
            auto furthest = plan_.tiles[tile].first;
            add(tile, [&](const Link& link) { furthest = std::max(furthest, Links::upper(link)); });
            tile_span = std::max(tile_span, plan_.tile_of(first_tile(), furthest) - tile);
        }
        plan_.colors.back().tile_span = tile_span;
    }
};

} // namespace sinew::detail

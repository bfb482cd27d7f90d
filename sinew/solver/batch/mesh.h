#pragma once

#include "sinew/solver/batch/batches.h"
#include "sinew/solver/batch/component_finder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

/// Layout of any mesh. Particles are ordered by level (level_structure.h). Sequences of links between consecutive slots
/// are batches, as in a cloth; sequences of a tile with hardly any common particles have the same colour. The remaining
/// links are coloured greedily: each gets the first colour unused at both ends.
namespace sinew::detail {

template <int D, class Real> class MeshMaker {
  public:
    MeshMaker(Solver<D, Real>& solver, ComponentFinder<D, Real>& parts, RunWriter<D, Real>& runs)
        : swept_(solver.sweep_state), plan_(solver.sweep_state.plan), room_(solver.sweep_state.room), parts_(parts),
          runs_(runs) {}

    void lay_out(std::size_t part) {
        begin_ = Row(swept_.row_of.size());
        lie_in_rows(part);
        room_.used.assign(parts_.members(part).size(), 0);
        sort_into_bands(part);
        find_sequences();
        for (std::uint32_t color = 0; color < families_; ++color) add_sequences(color);
        colour();
    }

  private:
    using Link = PlanRoom::Link;
    static constexpr std::uint32_t most_families = 63;
    static constexpr std::uint32_t least_in_sequence = 6; ///< shorter sequences are faster as scattered links

    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    ComponentFinder<D, Real>& parts_;
    RunWriter<D, Real>& runs_;
    Row begin_ = 0; ///< first slot of the component
    std::uint32_t families_ = 0;
    std::array<std::uint32_t, most_families> reaches_{}; ///< reach of each colour, in tiles

    std::uint32_t first_tile() const { return plan_.components.back().first_tile; }

    /// Slots of a level: every second particle, then the others, since neighbours share a link.
    void lie_in_rows(std::size_t part) {
        const auto all = parts_.members(part);
        constexpr Row least_in_band = 128;
        parts_.list_neighbours(part);
        auto& levels = room_.levels;
        levels.find(room_.near);
        Row tile = begin_;
        for (std::size_t i = 0; i < levels.size(); ++i) {
            for (std::size_t c = 0; c < 2; ++c)
                for (std::size_t k = c; k < levels[i].size(); k += 2) swept_.give_slot(all[levels[i][k]]);
            if (swept_.size() - tile < least_in_band && i + 1 < levels.size()) continue;
            plan_.tiles.push_back({tile, swept_.size()});
            tile = swept_.size();
        }
        parts_.forget_neighbours();
    }

    Link link_at(Row row) const {
        const auto [a, b] = std::minmax({swept_.slot_of[parts_.end(row, 0)], swept_.slot_of[parts_.end(row, 1)]});
        return {.apart = b - a, .lower = a, .row = row};
    }

    /// Sorts the links into tiles, by their lower end. `at` holds the end of each tile's range in `sorted`.
    void sort_into_bands(std::size_t part) {
        const auto tile_of = [&](Row link) { return plan_.tile_of(first_tile(), link_at(link).lower) - first_tile(); };
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
        families_ = 0;
        std::uint32_t first = 0;
        for (std::uint32_t tile = 0; tile < room_.at.size(); first = room_.at[tile++]) {
            const auto rows = std::span(room_.sorted).subspan(first, room_.at[tile] - first);
            links.clear();
            for (const Row row : rows) links.push_back(link_at(row));
            std::sort(links.begin(), links.end());
            for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = links[i].row;
            find_sequences(first_tile() + tile, first);
        }
    }

    /// Sequences of a tile, whose first link is number `begin` in `sorted`.
    void find_sequences(std::uint32_t tile, std::uint32_t begin) {
        const auto& links = room_.of_tile;
        auto& left = room_.left_of_tile;
        left.clear();
        for (std::size_t i = 0, end; i < links.size(); i = end) {
            end = sequence_end(tile, i);
            const auto sequence = std::span(links).subspan(i, end - i);
            const auto color = sequence.size() < least_in_sequence ? most_families : family_for(tile, sequence);
            if (color == most_families) {
                left.insert(left.end(), sequence.begin(), sequence.end());
                continue;
            }
            use(sequence, std::uint64_t(1) << color);
            families_ = std::max(families_, color + 1);
            room_.sequences.push_back({std::uint32_t(begin + i), std::uint32_t(begin + end), tile, color});
        }
        for (const auto& link : links) room_.used[link.lower - begin_] = room_.used[upper(link) - begin_] = 0;
        std::sort(left.begin(), left.end(), [](const Link& a, const Link& b) {
            return std::tuple(a.lower, a.apart, a.row) < std::tuple(b.lower, b.apart, b.row);
        });
        for (const auto& link : left) room_.left_over.push_back(link.row);
    }

    std::size_t sequence_end(std::uint32_t tile, std::size_t first) const {
        constexpr std::uint32_t most_lanes = 32; // in two packs
        const auto& links = room_.of_tile;
        const auto& begun = links[first];
        const auto most = begun.apart < most_lanes ? begun.apart : std::uint32_t(links.size());
        const auto into = plan_.tiles[plan_.tile_of(tile, upper(begun))].last;
        auto end = first + 1;
        while (end < links.size() && end - first < most && links[end].apart == begun.apart &&
               links[end].lower == links[end - 1].lower + 1 && upper(links[end]) < into)
            ++end;
        return end;
    }

    static std::uint32_t upper(const Link& link) { return link.lower + link.apart; }
    std::uint64_t used(const Link& link) const {
        return room_.used[link.lower - begin_] | room_.used[upper(link) - begin_];
    }
    /// First colour of the same reach which has hardly any of the sequence's particles yet. The reach must be equal
    /// since a colour of reach 0 adds no delay.
    std::uint32_t family_for(std::uint32_t tile, std::span<const Link> sequence) {
        constexpr std::size_t shared = 8; // at most one link of eight
        const auto reach = plan_.tile_of(tile, upper(sequence.front())) - tile;
        for (std::uint32_t color = 0; color < families_; ++color) {
            std::size_t taken = 0;
            for (const auto& link : sequence) taken += used(link) >> color & 1;
            if (reaches_[color] == reach && taken * shared <= sequence.size()) return color;
        }
        if (families_ < most_families) reaches_[families_] = reach;
        return families_;
    }
    void use(std::span<const Link> links, std::uint64_t colors) {
        for (const auto& link : links) {
            room_.used[link.lower - begin_] |= colors;
            room_.used[upper(link) - begin_] |= colors;
        }
    }

    void add_sequences(std::uint32_t color) {
        std::size_t next = 0;
        add_family([&](std::uint32_t tile, auto&& note) {
            for (; next < room_.sequences.size(); ++next) {
                const auto& sequence = room_.sequences[next];
                if (sequence.tile != tile) break;
                if (sequence.color != color) continue;
                for (auto i = sequence.first; i < sequence.end; ++i) {
                    const auto link = link_at(room_.sorted[i]);
                    runs_.add_listed(link.row, link.lower, upper(link), i == sequence.first);
                    note(link);
                }
            }
        });
    }

    void colour() {
        const auto& left = room_.left_over;
        if (left.empty()) return;
        constexpr auto last_colour = most_families; // links beyond the last colour are solved one by one
        std::uint32_t colours = 0;
        bool any_last = false;
        room_.colour.clear();
        for (const Row row : left) {
            const auto link = link_at(row);
            const auto colour = std::min(std::uint32_t(std::countr_one(used(link))), last_colour);
            room_.colour.push_back((unsigned char)(colour));
            if (colour == last_colour) {
                any_last = true;
                continue;
            }
            use(std::span(&link, 1), std::uint64_t(1) << colour);
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
            for (begin = end; end < left.size() && link_at(left[end]).lower < behind;) ++end;
            for (auto colour = first; colour <= last; ++colour) {
                runs_.break_run();
                for (auto i = begin; i < end; ++i) {
                    if (room_.colour[i] != colour) continue;
                    const auto link = link_at(left[i]);
                    if (colour == most_families)
                        runs_.begin_run(link.row, link.lower, upper(link));
                    else
                        runs_.add_scattered(link.row, link.lower, upper(link));
                    note(link);
                }
            }
        });
    }

    /// Adds a colour to the plan. Calls add(tile, note) for each tile; `add` passes every link to `note`.
    template <class Add> void add_family(Add&& add) {
        runs_.begin_family();
        std::uint32_t reach = 0;
        for (auto tile = first_tile(); tile < plan_.tiles.size(); ++tile) {
            runs_.begin_band();
            auto furthest = plan_.tiles[tile].first;
            add(tile, [&](const Link& link) { furthest = std::max(furthest, upper(link)); });
            reach = std::max(reach, plan_.tile_of(first_tile(), furthest) - tile);
        }
        plan_.colors.back().reach = reach;
    }
};

} // namespace sinew::detail

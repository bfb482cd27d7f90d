#pragma once

#include "sinew/solver/batch/batches.h"
#include "sinew/solver/batch/component_finder.h"

#include <algorithm>

/// Order of a component whose links have few directions, as in a cloth.
namespace sinew::detail {

/// Each direction is a color: all of one direction and then all of the next leaves a quarter of the stretch of a random
/// order, and cell by cell can grow without bound.
template <int D, class Real> class GridBuilder {
  public:
    GridBuilder(Solver<D, Real>& solver, ComponentFinder<D, Real>& parts, RunWriter<D, Real>& runs)
        : swept_(solver.sweep_state), plan_(solver.sweep_state.plan), room_(solver.sweep_state.room), parts_(parts),
          runs_(runs) {}

    /// Lists the directions, steps from one end's rank to the other's, in order of appearance. False if there are too
    /// many.
    bool find(std::size_t part) {
        constexpr std::size_t max = 24, min_each = 16;
        auto& directions = room_.directions;
        directions.clear();
        const auto all = parts_.links(part);
        auto at = directions.end();
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto step = direction_of(all[i]);
            if (at == directions.end() || at->step != step) {
                at = std::find_if(directions.begin(), directions.end(), [&](const auto& d) { return d.step == step; });
                if (at == directions.end()) at = directions.insert(at, {.step = step, .first = i});
                if (directions.size() > max) return false;
            }
            at->last = i + 1;
        }
        return !directions.empty() && all.size() / directions.size() >= min_each;
    }

    /// Neighbours in a row share links with each other; every second particle (or fourth, with longer links) does not.
    /// Particles of a row are therefore ordered by index modulo 2 or 4.
    void lay_out(std::size_t part) {
        const auto all = parts_.members(part);
        auto& chained = room_.chained; // to the next particle of the row
        chained.assign(all.size(), 0);
        std::uint32_t classes = 1;
        for (const Row link : parts_.links(part)) {
            const auto direction = direction_of(link);
            if (direction > 3) continue;
            classes = std::max(classes, direction == 1 ? 2U : 4U);
            if (direction == 1) chained[std::min(parts_.rank(link, 0), parts_.rank(link, 1))] = 1;
        }
        const auto begin = Row(swept_.row_of.size());
        Row tile = begin;
        constexpr Row min_in_band = 128;
        for (std::size_t first = 0, last; first < all.size(); first = last) {
            last = first + 1;
            while (last < all.size() && chained[last - 1]) ++last;
            for (std::size_t c = 0; c < classes; ++c)
                for (std::size_t i = first + c; i < last; i += classes) swept_.give_slot(all[i]);
            if (Row(swept_.row_of.size()) - tile < min_in_band && last < all.size()) continue;
            plan_.tiles.push_back({tile, Row(swept_.row_of.size())});
            tile = Row(swept_.row_of.size());
        }
        for (const auto& direction : room_.directions) add_direction(part, direction);
    }

    /// True if links join neighbours within a row or from row to row, up to the third. Then one sweep in the order of
    /// directions is stable; links that close a ring or lead to a hub are not of a sheet. After lay_out.
    bool is_sheet(std::size_t part) const {
        constexpr Row furthest = 3;
        auto &row_of = room_.at, &column_of = room_.left;
        const auto count = parts_.members(part).size();
        row_of.assign(count, 0), column_of.assign(count, 0);
        for (std::size_t i = 1; i < count; ++i) {
            row_of[i] = row_of[i - 1] + (room_.chained[i - 1] ? 0 : 1);
            column_of[i] = room_.chained[i - 1] ? column_of[i - 1] + 1 : 0;
        }
        const auto near = [](Row a, Row b) { return (a < b ? b - a : a - b) <= furthest; };
        return std::ranges::all_of(parts_.links(part), [&](Row link) {
            const Row a = parts_.rank(link, 0), b = parts_.rank(link, 1);
            return near(row_of[a], row_of[b]) && near(column_of[a], column_of[b]);
        });
    }

  private:
    static constexpr Row none = ~Row(0);

    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    ComponentFinder<D, Real>& parts_;
    RunWriter<D, Real>& runs_;

    Row direction_of(Row link) const {
        const Row a = parts_.rank(link, 0), b = parts_.rank(link, 1);
        return a < b ? b - a : a - b;
    }

    /// Adds the links of a direction, ordered by the slot of the first particle. Links with the same first particle go
    /// into separate colors.
    void add_direction(std::size_t part, const PlanRoom::Direction& direction) {
        auto& at = room_.at;
        const auto first_tile = plan_.components.back().first_tile;
        const Row begin = plan_.tiles[first_tile].first;
        auto& left = room_.left;
        left.clear();
        for (const Row link : parts_.links(part).subspan(direction.first, direction.last - direction.first))
            if (direction_of(link) == direction.step) left.push_back(link);
        while (!left.empty()) {
            at.assign(parts_.members(part).size(), none);
            std::size_t kept = 0;
            for (const Row link : left) {
                Row& position = at[lower_slot(link) - begin];
                if (position == none)
                    position = link;
                else
                    left[kept++] = link;
            }
            left.resize(kept);
            add_family(first_tile, begin);
        }
    }
    Row lower_end(Row link) const {
        return parts_.rank(link, 0) < parts_.rank(link, 1) ? parts_.end(link, 0) : parts_.end(link, 1);
    }
    Row upper_end(Row link) const {
        return parts_.rank(link, 0) < parts_.rank(link, 1) ? parts_.end(link, 1) : parts_.end(link, 0);
    }
    Row lower_slot(Row link) const { return swept_.slot_of[lower_end(link)]; }

    void add_family(std::uint32_t first_tile, Row begin) {
        runs_.begin_family();
        std::uint32_t tile_span = 0;
        for (auto tile = first_tile; tile < plan_.tiles.size(); ++tile) {
            runs_.begin_band();
            auto furthest = plan_.tiles[tile].first;
            for (Row s = plan_.tiles[tile].first; s < plan_.tiles[tile].last; ++s) {
                const Row link = room_.at[s - begin];
                if (link == none) continue;
                const Row other = swept_.slot_of[upper_end(link)];
                runs_.add(link, s, other);
                furthest = std::max(furthest, other);
            }
            tile_span = std::max(tile_span, plan_.tile_of(first_tile, furthest) - tile);
        }
        plan_.colors.back().tile_span = tile_span;
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/batch/mesh.h"

/// Order of a component's particles and links. Where links have few directions, as in a cloth, each direction is a
/// color: all of one direction and then all of the next leaves a quarter of the stretch of a random order, and cell by
/// cell can grow without bound. Any other mesh is coloured. Many copies of one small shape are interleaved, particle i
/// of all copies before i + 1, and each copy is solved in the order of its links.
namespace sinew::detail {

template <int D, class Real> class SheetMaker {
  public:
    SheetMaker(World<D, Real>& world, Solver<D, Real>& solver, ComponentFinder<D, Real>& parts)
        : world_(world), solver_(solver), swept_(solver.sweep_state), plan_(solver.sweep_state.plan),
          room_(solver.sweep_state.room), parts_(parts), runs_(world, solver), mesh_(solver, parts, runs_),
          particle_ids_(world.particles.slots), link_ids_(std::get<kind_number<Distance, D>>(world.constraints).slots) {
    }

    static constexpr std::size_t most_in_copies = 1024; ///< particles

    /// Lays out `parts` parts; those of the same shape share components where they are many and small.
    void lay_out(std::size_t part, std::size_t parts) {
        for (const auto last = part + parts; part < last;)
            part += lay_out_alike(part, std::min(last - part, parts_.count_alike(part)));
    }

  private:
    static constexpr Row none = ~Row(0);

    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    ComponentFinder<D, Real>& parts_;
    RunWriter<D, Real> runs_;
    MeshMaker<D, Real> mesh_;
    const Slots<ParticleTag>& particle_ids_;
    const Slots<ConstraintTag>& link_ids_;

    std::size_t lay_out_alike(std::size_t part, std::size_t alike) {
        constexpr std::size_t many = 8;
        if (alike >= many && members(part).size() <= most_in_copies)
            lay_out_copies(part, alike);
        else
            for (std::size_t i = part; i < part + alike; ++i) lay_out(i);
        return alike;
    }

    void lay_out(std::size_t part) {
        begin_sheet(part);
        constexpr std::size_t few = 64; // links; fewer are solved in row order
        if (find_directions(part))
            lay_out_directions(part);
        else if (links(part).size() < few)
            lay_out_list(part);
        else
            mesh_.lay_out(part);
        end_sheet();
    }

    /// Interleaves copies, particle i of all before i + 1: as many copies in a component as fit the fastest cache.
    void lay_out_copies(std::size_t part, std::size_t copies) {
        constexpr std::size_t cached = 1024, least = 64, lanes = 16;
        const auto fitting = cached / members(part).size() / lanes * lanes;
        const auto each = std::max(least, fitting);
        for (std::size_t first = 0; first < copies; first += each) {
            const auto count = std::min(each, copies - first);
            const auto begin = Row(swept_.row_of.size());
            begin_sheet(part);
            plan_.components.back().copies = std::uint32_t(count);
            for (std::size_t i = 0; i < members(part).size(); ++i)
                for (std::size_t copy = 0; copy < count; ++copy) swept_.give_slot(members(part + first + copy)[i]);
            plan_.tiles.push_back({begin, Row(swept_.row_of.size())});
            runs_.begin_family();
            runs_.begin_band();
            for (std::size_t i = 0; i < links(part).size(); ++i) {
                runs_.break_run();
                for (std::size_t copy = 0; copy < count; ++copy) {
                    const Row link = links(part + first + copy)[i];
                    runs_.add(link, slot(end(link, 0)), slot(end(link, 1)));
                }
            }
            end_sheet();
        }
    }

    std::span<const Row> members(std::size_t part) const { return parts_.members(part); }
    std::span<const Row> links(std::size_t part) const { return parts_.links(part); }
    Row rank(Row link, std::size_t i) const { return parts_.rank(link, i); }
    Row end(Row link, std::size_t i) const { return parts_.end(link, i); }
    Row slot(Row row) const { return swept_.slot_of[row]; }

    bool has_port(std::size_t part) const {
        const auto& ports = solver_.blocks.ports;
        return !ports.list.empty() &&
               std::ranges::any_of(members(part), [&](Row row) { return ports.at[row] != ports.none; });
    }

    /// Corrections along old directions keep the energy of a swing, provided that a sweep nearly converges. In a mesh a
    /// sweep does not, and old directions gain nothing (docs/measured/sweep.md); beside a port they would add energy.
    void begin_sheet(std::size_t part) {
        runs_.begin_sheet(2 * links(part).size() <= 3 * members(part).size() && !has_port(part));
        const auto begin = plan_.end();
        plan_.components.push_back({.first_tile = begin.tile,
                                    .first_color = begin.color,
                                    .begin = begin,
                                    .small = members(part).size() <= most_in_copies});
    }

    void end_sheet() {
        auto& component = plan_.components.back();
        component.tiles = std::uint32_t(plan_.tiles.size()) - component.first_tile;
        component.colors = std::uint32_t(plan_.colors.size()) - component.first_color;
        std::uint32_t wavefront_offset = 0;
        for (auto f = component.first_color; f < plan_.colors.size(); ++f) {
            auto& color = plan_.colors[f];
            color.wavefront_offset = wavefront_offset += color.reach;
            component.reach = std::max(component.reach, color.reach);
        }
        component.wavefront_offset = wavefront_offset;
        component.links = runs_.links();
        for (auto slot = component.begin.slot; slot < swept_.row_of.size(); ++slot)
            component.particles.include(swept_.row_of[slot]);
        SINEW_ASSERT(!component.particles.empty(), "a component has particles");
        SINEW_ASSERT(plan_.tiles.back().last == swept_.row_of.size(), "the tiles hold every slot");
        know(component.particles, particle_ids_);
        if (!component.links.empty()) know(component.links, link_ids_);
    }
    template <class Slots> static void know(Extent& extent, const Slots& ids) {
        extent.first_id = ids.slot_of(extent.first);
        extent.last_id = ids.slot_of(extent.last);
    }

    void lay_out_list(std::size_t part) {
        const auto begin = Row(swept_.row_of.size());
        for (const Row row : members(part)) swept_.give_slot(row);
        plan_.tiles.push_back({begin, Row(swept_.row_of.size())});
        if (links(part).empty()) return;
        runs_.begin_family();
        runs_.begin_band();
        for (const Row link : links(part)) runs_.add(link, slot(end(link, 0)), slot(end(link, 1)));
    }

    // --- directions -------------------------------------------------------------------------------------------------

    /// Lists the directions, steps from one end's rank to the other's, in order of appearance. False if there are too
    /// many.
    bool find_directions(std::size_t part) {
        constexpr std::size_t most = 24, least_each = 16;
        auto& directions = room_.directions;
        directions.clear();
        const auto all = links(part);
        auto at = directions.end();
        for (std::size_t i = 0; i < all.size(); ++i) {
            const auto step = direction_of(all[i]);
            if (at == directions.end() || at->step != step) {
                at = std::find_if(directions.begin(), directions.end(), [&](const auto& d) { return d.step == step; });
                if (at == directions.end()) at = directions.insert(at, {.step = step, .first = i});
                if (directions.size() > most) return false;
            }
            at->last = i + 1;
        }
        return !directions.empty() && all.size() / directions.size() >= least_each;
    }

    Row direction_of(Row link) const {
        const Row a = rank(link, 0), b = rank(link, 1);
        return a < b ? b - a : a - b;
    }

    /// Neighbours in a row share links with each other; every second particle (or fourth, with longer links) does not.
    /// Particles of a row are therefore ordered by index modulo 2 or 4.
    void lay_out_directions(std::size_t part) {
        const auto all = members(part);
        auto& chained = room_.chained; // to the next particle of the row
        chained.assign(all.size(), 0);
        std::uint32_t classes = 1;
        for (const Row link : links(part)) {
            const auto direction = direction_of(link);
            if (direction > 3) continue;
            classes = std::max(classes, direction == 1 ? 2U : 4U);
            if (direction == 1) chained[std::min(rank(link, 0), rank(link, 1))] = 1;
        }
        const auto begin = Row(swept_.row_of.size());
        Row tile = begin;
        constexpr Row least_in_band = 128;
        for (std::size_t first = 0, last; first < all.size(); first = last) {
            last = first + 1;
            while (last < all.size() && chained[last - 1]) ++last;
            for (std::size_t c = 0; c < classes; ++c)
                for (std::size_t i = first + c; i < last; i += classes) swept_.give_slot(all[i]);
            if (Row(swept_.row_of.size()) - tile < least_in_band && last < all.size()) continue;
            plan_.tiles.push_back({tile, Row(swept_.row_of.size())});
            tile = Row(swept_.row_of.size());
        }
        for (const auto& direction : room_.directions) add_direction(part, direction);
    }

    /// Adds the links of a direction, ordered by the slot of the first particle. Links with the same first particle go
    /// into separate colors.
    void add_direction(std::size_t part, const PlanRoom::Direction& direction) {
        auto& at = room_.at;
        const auto first_tile = plan_.components.back().first_tile;
        const Row begin = plan_.tiles[first_tile].first;
        auto& left = room_.left;
        left.clear();
        for (const Row link : links(part).subspan(direction.first, direction.last - direction.first))
            if (direction_of(link) == direction.step) left.push_back(link);
        while (!left.empty()) {
            at.assign(members(part).size(), none);
            std::size_t kept = 0;
            for (const Row link : left) {
                Row& place = at[lower_slot(link) - begin];
                if (place == none)
                    place = link;
                else
                    left[kept++] = link;
            }
            left.resize(kept);
            add_family(first_tile, begin);
        }
    }
    Row lower_end(Row link) const { return rank(link, 0) < rank(link, 1) ? end(link, 0) : end(link, 1); }
    Row upper_end(Row link) const { return rank(link, 0) < rank(link, 1) ? end(link, 1) : end(link, 0); }
    Row lower_slot(Row link) const { return slot(lower_end(link)); }

    void add_family(std::uint32_t first_tile, Row begin) {
        runs_.begin_family();
        std::uint32_t reach = 0;
        for (auto tile = first_tile; tile < plan_.tiles.size(); ++tile) {
            runs_.begin_band();
            auto furthest = plan_.tiles[tile].first;
            for (Row s = plan_.tiles[tile].first; s < plan_.tiles[tile].last; ++s) {
                const Row link = room_.at[s - begin];
                if (link == none) continue;
                const Row other = slot(upper_end(link));
                runs_.add(link, s, other);
                furthest = std::max(furthest, other);
            }
            reach = std::max(reach, plan_.tile_of(first_tile, furthest) - tile);
        }
        plan_.colors.back().reach = reach;
    }
};

} // namespace sinew::detail

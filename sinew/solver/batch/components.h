#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/batch/grid.h"
#include "sinew/solver/batch/mesh.h"

#include <algorithm>

/// Order of a component's particles and links: a grid where links have few directions, else a mesh, coloured. Many
/// copies of one small shape are interleaved, particle i of all copies before i + 1, and each copy is solved in the
/// order of its links.
namespace sinew::detail {

template <int D, class Real> class ComponentBuilder {
  public:
    ComponentBuilder(World<D, Real>& world, Solver<D, Real>& solver, ComponentFinder<D, Real>& parts)
        : world_(world), solver_(solver), swept_(solver.sweep_state), plan_(solver.sweep_state.plan),
          room_(solver.sweep_state.room), parts_(parts), runs_(world, solver), grid_(solver, parts, runs_),
          mesh_(solver, parts, runs_), particle_ids_(world.particles.handles),
          link_ids_(std::get<kind_number<Distance, D>>(world.constraints).handles) {}

    static constexpr std::size_t max_in_copies = 1024; ///< particles

    /// Lays out `parts` parts; those of the same shape share components where they are many and small.
    void lay_out(std::size_t part, std::size_t parts) {
        for (const auto last = part + parts; part < last;)
            part += lay_out_alike(part, std::min(last - part, parts_.count_alike(part)));
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& swept_;
    Plan<Real>& plan_;
    PlanRoom& room_;
    ComponentFinder<D, Real>& parts_;
    RunWriter<D, Real> runs_;
    GridBuilder<D, Real> grid_;
    MeshBuilder<D, Real> mesh_;
    const HandleMap<ParticleTag>& particle_ids_;
    const HandleMap<ConstraintTag>& link_ids_;

    std::size_t lay_out_alike(std::size_t part, std::size_t alike) {
        constexpr std::size_t many = 8;
        if (alike >= many && members(part).size() <= max_in_copies)
            lay_out_copies(part, alike);
        else
            for (std::size_t i = part; i < part + alike; ++i) lay_out(i);
        return alike;
    }

    void lay_out(std::size_t part) {
        begin_sheet(part);
        constexpr std::size_t few = 64; // links; fewer are solved in row order
        if (grid_.find(part)) {
            grid_.lay_out(part);
            end_sheet(D == 3 && grid_.is_sheet(part));
        } else if (links(part).size() < few) {
            lay_out_list(part);
            end_sheet(is_path(part));
        } else {
            mesh_.lay_out(part);
            end_sheet(D == 3 && !is_elastic() && !has_hub(part));
        }
    }

    /// Interleaves copies, particle i of all before i + 1: as many copies in a component as fit the fastest cache.
    void lay_out_copies(std::size_t part, std::size_t copies) {
        constexpr std::size_t cached = 1024, min = 64, lanes = 16;
        const auto fitting = cached / members(part).size() / lanes * lanes;
        const auto each = std::max(min, fitting);
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
            end_sheet(is_path(part));
        }
    }

    std::span<const Row> members(std::size_t part) const { return parts_.members(part); }
    std::span<const Row> links(std::size_t part) const { return parts_.links(part); }
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
                                    .small = members(part).size() <= max_in_copies});
    }

    /// True for links that form open chains, of which any order converges without oscillation.
    bool is_path(std::size_t part) const { return links(part).size() < members(part).size() && max_degree(part) <= 2; }
    /// True if a particle has more links than any of a regular mesh: eight to neighbours, four to the next but one.
    bool has_hub(std::size_t part) const {
        constexpr Row max_regular = 12;
        return max_degree(part) > max_regular;
    }
    /// Largest number of links of a particle.
    Row max_degree(std::size_t part) const {
        auto& degree = room_.at;
        degree.assign(members(part).size(), 0);
        Row max = 0;
        for (const Row link : links(part))
            for (std::size_t i = 0; i < 2; ++i) max = std::max(max, ++degree[parts_.rank(link, i)]);
        return max;
    }
    /// True if a link of the last component is compliant.
    bool is_elastic() const {
        const auto runs = std::span(plan_.runs).subspan(plan_.components.back().begin.run);
        return std::ranges::any_of(runs, &LinkBatch::compliant);
    }

    /// `is_regular`: links in an order that is stable in one direction (docs/concepts/order-and-lanes.md). Sheets in a
    /// plane are not: they can be crushed, which folds cells over each other.
    void end_sheet(bool is_regular) {
        auto& component = plan_.components.back();
        component.tiles = std::uint32_t(plan_.tiles.size()) - component.first_tile;
        component.colors = std::uint32_t(plan_.colors.size()) - component.first_color;
        std::uint32_t wavefront_offset = 0;
        for (auto f = component.first_color; f < plan_.colors.size(); ++f) {
            auto& color = plan_.colors[f];
            color.wavefront_offset = wavefront_offset += color.tile_span;
            component.tile_span = std::max(component.tile_span, color.tile_span);
        }
        component.wavefront_offset = wavefront_offset;
        component.is_elastic = is_elastic();
        component.both_ways = component.has_links() && !is_regular;
        if (component.both_ways)
            component.wavefront_offset = plan_.offset_of_return(component, 0) + component.tiles - 1;
        component.links = runs_.links();
        for (auto slot = component.begin.slot; slot < swept_.row_of.size(); ++slot)
            component.particles.include(swept_.row_of[slot]);
        SINEW_ASSERT(!component.particles.empty(), "a component has particles");
        SINEW_ASSERT(plan_.tiles.back().last == swept_.row_of.size(), "the tiles hold every slot");
        know(component.particles, particle_ids_);
        if (!component.links.empty()) know(component.links, link_ids_);
    }
    template <class Handles> static void know(Extent& extent, const Handles& ids) {
        extent.first_id = ids.index_of(extent.first);
        extent.last_id = ids.index_of(extent.last);
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
};

} // namespace sinew::detail

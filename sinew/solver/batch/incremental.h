#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/plan.h"

/// Moving the components of a plan, within the plan or to another.
namespace sinew::detail {

/// A plan, and the rows of the particles in the slots.
template <class Real> struct IncrementalPlan {
    Plan<Real>& plan;
    std::vector<Row>& row_of;

    /// Appends a component of another plan, without tethers.
    void append(const IncrementalPlan& from, std::size_t number) {
        SINEW_ASSERT(number < from.plan.components.size() && &from.plan != &plan, "a component of the other plan");
        Component component = from.plan.components[number];
        const auto first = component.begin, last = from.plan.end_of(number), to = plan.end();
        const auto slots = to.slot - first.slot;
        copy(from.row_of, first.slot, last.slot, row_of);
        copy(from.plan.tiles, first.tile, last.tile, plan.tiles,
             [&](Tile& tile) { tile.first += slots, tile.last += slots; });
        copy(from.plan.colors, first.color, last.color, plan.colors,
             [&](LinkColor& color) { color.first_batch += to.first_batch - first.first_batch; });
        copy(from.plan.first_batch, first.first_batch, last.first_batch, plan.first_batch,
             [&](std::uint32_t& run) { run += to.run - first.run; });
        copy(from.plan.runs, first.run, last.run, plan.runs, [&](LinkBatch& run) {
            run.a += run.scattered ? to.scattered - first.scattered : slots;
            run.b += run.scattered ? 0 : slots;
            run.row += run.row_step == 0 ? to.listed - first.listed : 0;
            run.parameters += to.parameter - first.parameter;
        });
        for (auto i = first.parameter; i < last.parameter; ++i) plan.parameters.add_copy(from.plan.parameters, i);
        const auto displacement = [&](std::uint32_t& slot) { slot += slots; };
        copy(from.plan.ends_a, first.scattered, last.scattered, plan.ends_a, displacement);
        copy(from.plan.ends_b, first.scattered, last.scattered, plan.ends_b, displacement);
        copy(from.plan.rows, first.listed, last.listed, plan.rows);
        SINEW_ASSERT(row_of.size() == plan.end().slot, "the tiles hold every slot");
        component.begin = to;
        component.first_tile = to.tile, component.first_color = to.color;
        plan.components.push_back(component);
    }

    /// Removes the components from number `number` on.
    void cut_off(std::size_t number) {
        SINEW_ASSERT(number <= plan.components.size(), "the component is in the plan");
        if (number == plan.components.size()) return;
        const auto end = plan.components[number].begin;
        row_of.resize(end.slot);
        plan.tiles.resize(end.tile);
        plan.colors.resize(end.color);
        plan.first_batch.resize(end.first_batch);
        plan.runs.resize(end.run);
        plan.parameters.resize(end.parameter);
        for (auto* column : {&plan.ends_a, &plan.ends_b}) column->resize(end.scattered);
        plan.rows.resize(end.listed);
        plan.components.resize(number);
    }

    /// Adds offsets to the rows of a component's particles and links.
    void shift(Component& component, Row particles, Row links) {
        const auto last = plan.end_of(component);
        component.particles.shift(particles);
        for (auto slot = component.begin.slot; slot < last.slot; ++slot) row_of[slot] += particles;
        if (links == 0) return;
        component.links.shift(links);
        for (auto run = component.begin.run; run < last.run; ++run)
            plan.runs[run].row += plan.runs[run].row_step == 0 ? 0 : links;
        for (auto i = component.begin.listed; i < last.listed; ++i) plan.rows[i] += links;
    }

  private:
    template <class T, class Change>
    static void copy(const std::vector<T>& from, std::size_t first, std::size_t last, std::vector<T>& to,
                     Change&& change) {
        const auto begin = to.size();
        copy(from, first, last, to);
        for (auto i = begin; i < to.size(); ++i) change(to[i]);
    }
    template <class T>
    static void copy(const std::vector<T>& from, std::size_t first, std::size_t last, std::vector<T>& to) {
        to.insert(to.end(), from.begin() + std::ptrdiff_t(first), from.begin() + std::ptrdiff_t(last));
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/solver/sweep/substep.h"

/// Order of an iteration over one component. The coupled sweep runs it pass after pass, the wavefront sweep tile after
/// tile, with the same result to the last bit.
namespace sinew::detail {

/// Number of tiles by which an iteration lags behind the iteration before.
template <int D, class Real> std::uint32_t wavefront_offset(const World<D, Real>& world, const Component& component) {
    const bool repairs = world.repair_window > 0 && component.tethers > 0;
    return component.wavefront_offset + (repairs ? world.repair_window - 1 + component.tile_span : 0);
}

/// The links there, in the order of the plan. Calls visit(offset, work) for every pass; work(tile) needs the passes
/// before to have finished all tiles up to tile + offset - (their offset).
template <int D, class Real, class Visit>
void for_each_color(const Plan<Real>& plan, Substep<D, Real>& substep, const Component& component, Visit&& visit) {
    for (std::uint32_t color = 0; color < component.colors; ++color)
        visit(plan.colors[component.first_color + color].wavefront_offset,
              [&](std::uint32_t tile) { substep.project(component, color, tile); });
}

/// The links back, in the reverse order down to the last link: there and back is symmetric Gauss-Seidel, which is
/// stable for any compliance, mass and step (docs/concepts/order-and-lanes.md). Item 0 of a pass is the last tile.
template <int D, class Real, class Visit>
void for_each_color_back(const Plan<Real>& plan, Substep<D, Real>& substep, const Component& component, Visit&& visit) {
    for (auto color = component.colors; color-- > 0;)
        visit(plan.offset_of_return(component, color),
              [&](std::uint32_t item) { substep.project_back(component, color, component.tiles - 1 - item); });
}

/// The repair of overstretched links, and the rows between two pins.
template <int D, class Real, class Visit>
void for_each_repair(const World<D, Real>& world, Substep<D, Real>& substep, const Component& component,
                     Visit&& visit) {
    if (world.repair_window)
        visit(wavefront_offset(world, component),
              [&](std::uint32_t tile) { substep.repair_overstretch(component, tile); });
    visit(wavefront_offset(world, component), [&](std::uint32_t tile) { substep.repair_spans(component, tile); });
}

/// All passes of an iteration over a component that no constraints of other kinds act on.
template <int D, class Real, class Visit>
void for_each_projection(const World<D, Real>& world, const Plan<Real>& plan, Substep<D, Real>& substep,
                         const Component& component, Visit&& visit) {
    for_each_color(plan, substep, component, visit);
    if (component.both_ways) for_each_color_back(plan, substep, component, visit);
    for_each_repair(world, substep, component, visit);
}

} // namespace sinew::detail

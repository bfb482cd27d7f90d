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

/// Calls visit(offset, work) for every pass: each colour, the repair of overstretched links, the rows between two pins.
/// work(tile) needs the passes before to have finished all tiles up to tile + offset - (their offset).
template <int D, class Real, class Visit>
void for_each_projection(const World<D, Real>& world, const Plan<Real>& plan, Substep<D, Real>& substep,
                         const Component& component, Visit&& visit) {
    for (std::uint32_t color = 0; color < component.colors; ++color)
        visit(plan.colors[component.first_color + color].wavefront_offset,
              [&](std::uint32_t tile) { substep.project(component, color, tile); });
    if (world.repair_window)
        visit(wavefront_offset(world, component),
              [&](std::uint32_t tile) { substep.repair_overstretch(component, tile); });
    visit(wavefront_offset(world, component), [&](std::uint32_t tile) { substep.repair_spans(component, tile); });
}

} // namespace sinew::detail

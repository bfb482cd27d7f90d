#pragma once

#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>

namespace sinew::detail {

/// Sets the repair window to twice the number of tiles repaired in a row: spreading strain is met, and calm components
/// cost little.
template <int D, class Real> void set_repair_window(World<D, Real>& world, Solver<D, Real>& solver) {
    constexpr std::uint32_t min = 4, max = 20;
    std::uint32_t longest = 0;
    for (auto& tile : solver.sweep_state.plan.tiles) {
        longest = std::max({longest, std::uint32_t(tile.overstretched), tile.again});
        tile.overstretched = false;
        tile.again = 0;
    }
    world.repair_window = longest > 0 ? std::clamp(2 * longest, min, max) : 0;
}

} // namespace sinew::detail

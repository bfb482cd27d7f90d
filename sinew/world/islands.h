#pragma once

#include "sinew/world/world.h"

namespace sinew {

/// Number of islands of each figure: sets of particles connected by constraints within the figure, distances without an
/// upper limit excepted. Names survive when a figure is cut or torn apart; a number above 1 tells.
template <int D, class Real> std::vector<std::size_t> islands(const World<D, Real>& world);

} // namespace sinew

#pragma once

#include "sinew/solver/world.h"

namespace sinew {

/// Moves the world on by dt (in its own time unit). dt = 0 changes nothing, nor does one that is negative, not a
/// number or below limit::shortest_step; a longer one than limit::step counts as that. Allocates nothing. What happened
/// is in world.events until the next step.
template <int D, class Real> void step(World<D, Real>& world, Real dt);

} // namespace sinew

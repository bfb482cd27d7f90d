#pragma once

#include "sinew/solver/world.h"

namespace sinew {

/// Moves the world on by dt (in its own time unit). dt = 0 changes nothing, nor does one that is negative, not a
/// number or below limit::shortest_step; a longer one than limit::step counts as that. What happened is in world.events
/// until the next step. Allocates nothing, but that the first step after an edit does what `prepare` does.
template <int D, class Real> void step(World<D, Real>& world, Real dt);

/// Looks what hangs together in a world that was edited and makes room to solve it; nothing to do in one that was not.
template <int D, class Real> void prepare(World<D, Real>& world);

} // namespace sinew

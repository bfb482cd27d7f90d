#pragma once

#include "sinew/solver/world.h"

namespace sinew {

/// Advances the world by dt, in the world's time unit. dt is clamped to limit::step; zero, negative, NaN or below
/// limit::shortest_step does nothing. Events stay in world.events until the next step. Allocates nothing, except that
/// the first step after an edit does the work of `prepare`.
template <int D, class Real> void step(World<D, Real>& world, Real dt);

/// Finds the connected components of an edited world and reserves memory for their solution; a no-op without edits.
template <int D, class Real> void prepare(World<D, Real>& world);

} // namespace sinew

#pragma once

#include "sinew/solver/sever.h"

namespace sinew {

/// Where links of a cloth are gone, a particle can be all that still joins two flaps: the cells around it fell apart
/// into several fans. Then each fan but the largest gets a particle of its own, in the same place and as fast, with its
/// share of the mass by number of links; the old one keeps its names and single threads. Constraints and drawn pieces
/// go with their fan; what reached across goes. Nothing is split that is pinned, or whose fans were apart before: a
/// hinge stays one. Returns how many particles were made. What has no cells is told so after a look at it; where there
/// are some, it takes time in proportion to the world.
template <int D, class Real> std::size_t split(World<D, Real>& world, std::span<const Ends> gone);

} // namespace sinew

#pragma once

#include "sinew/topology/split_pieces.h"

namespace sinew {

/// Vertex splitting. After links of a cloth are removed, a particle may be the only connection between flaps: the cells
/// around fell apart into several fans. Then each fan but the largest gets a new particle of the same position and
/// velocity, with a share of the mass in proportion to the links; the old particle keeps names and single links.
/// Constraints and drawn pieces follow their fan; a constraint across several fans is removed. Pinned particles are
/// never split, nor fans which were separate before: a hinge stays whole. Returns the number of particles added. Cheap
/// without cells near the gaps; otherwise takes time proportional to the world.
template <int D, class Real> std::size_t split(World<D, Real>& world, std::span<const Ends> gone);

} // namespace sinew

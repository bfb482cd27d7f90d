#pragma once

#include "sinew/solver/world.h"

#include <span>

namespace sinew {

/// Two particles that a distance joined until it was cut or torn.
using Ends = std::array<ParticleId, 2>;

/// What is drawn from one particle to another whose link is gone comes apart there: lines become shorter lines, closed
/// lines open, a patch of cloth goes; a filled polygon falls into the parts between its gaps.
template <int D, class Real> void sever(World<D, Real>& world, std::span<const Ends> gone);

} // namespace sinew

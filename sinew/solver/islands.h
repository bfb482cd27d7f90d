#pragma once

#include "sinew/solver/world.h"

namespace sinew {

/// Into how many islands each figure falls: sets of its particles that constraints join. Distances that only keep
/// apart do not. A figure that is cut or torn apart keeps its name, and so do its particles; this tells
/// that it is several.
template <int D, class Real> std::vector<std::size_t> islands(const World<D, Real>& world);

} // namespace sinew

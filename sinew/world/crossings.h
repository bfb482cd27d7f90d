#pragma once

#include "sinew/world/world_types.h"

#include <cstddef>

namespace sinew {

template <int D, class Real> struct World;

/// Number of edges of cloth that pass through faces of cloth, of the same or another figure: 0 for layers that lie on
/// each other. Faces are the whole cells of cloth, divided into triangles; in two dimensions nothing is counted. An
/// edge that lies in the plane of a face, ends on it or meets its rim, to within the rounding of the positions, does
/// not pass through. Slow: for tests and reports.
template <int D, class Real> std::size_t count_crossings(const World<D, Real>& world);

} // namespace sinew

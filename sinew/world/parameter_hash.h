#pragma once

#include <cstdint>

namespace sinew {

template <int D, class Real> struct World;

/// Hash of everything that edits change and a step does not: settings, forces, walls, constraints, pins, figures,
/// masses, positions of sleepers. Motions are left out: other positions, velocities, forces on particles, targets of
/// pins and of colliders.
template <int D, class Real> std::uint64_t parameter_hash(const World<D, Real>& world);

} // namespace sinew

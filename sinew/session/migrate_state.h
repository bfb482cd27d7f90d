#pragma once

#include "sinew/scene/scene.h"

namespace sinew {

/// Copies state into the world of an edited scene: the clock and, for every figure described identically in both
/// scenes, positions, velocities and removals. No effect if the worlds differ in dimension or precision.
void migrate_state(const Scene& scene, const AnyWorld& world, const Scene& edited, AnyWorld& fresh);

} // namespace sinew

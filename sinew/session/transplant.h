#pragma once

#include "sinew/scene/scene.h"

namespace sinew {

/// Carries a world over into that of an edited scene: the clock, and of every figure that both scenes say in the same
/// words where its particles are, how they move, and what of it is gone. Nothing where the worlds differ in dimension
/// or precision.
void transplant(const Scene& scene, const AnyWorld& world, const Scene& edited, AnyWorld& fresh);

} // namespace sinew

#pragma once

#include "sinew/scene/scene.h"

#include <cstddef>
#include <vector>

namespace sinew {

/// Copies state into the world of an edited scene: the clock and, for every figure that begins alike in both scenes,
/// positions, velocities and removals. A figure that was moved, turned or made larger in the description is moved,
/// turned about its present middle and made larger as it is; a change of mass or friction leaves it as it moves. One of
/// another form begins anew. Returns the figures of the new world that go on: none if the worlds differ in dimension or
/// precision.
std::vector<FigureIndex> migrate_state(const Scene& scene, const AnyWorld& world, const Scene& edited, AnyWorld& fresh);

/// A world, and its number of figures that the scene describes; the others are built by code (level.h).
template <class WorldT> struct BuiltWorld {
    WorldT& world;
    std::size_t described = 0;
};

/// The same for the figures that code has built: those of the same name whose particles and constraints are the same,
/// and particles of no figure if there are as many as before.
void migrate_built(const BuiltWorld<const AnyWorld>& from, const BuiltWorld<AnyWorld>& into);

} // namespace sinew

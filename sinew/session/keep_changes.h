#pragma once

#include "sinew/scene/scene.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace sinew {

/// A world that takes the place of another: that of an edited scene, with the state of the figures that go on.
struct Replacement {
    const Scene& scene;                    ///< the scene before
    const Scene& edited;                   ///< and after
    const AnyWorld& old;                   ///< its world
    AnyWorld& fresh;                       ///< the new one, as migrate_state() leaves it
    std::span<const FigureIndex> going_on; ///< figures of the new world that keep their state
    std::span<const PinId> not_kept{};     ///< pins of the old world that others make anew
};

/// Ids of a world before and after keep_changes(), in order of those before.
struct Renamed {
    std::vector<std::array<PinId, 2>> pins;
    std::vector<std::array<ConstraintId, 2>> constraints;

    void sort();
    void rename(PinId& id) const;
    void rename(ConstraintId& id) const;
};

/// Brings into the new world all changes by calls and events of the old one since its scene was built: figures,
/// particles, constraints, pins, colliders and forces that were added, those that were removed, and numbers that were
/// set, as long as the edit leaves their descriptions alone. Ids of the old world hold in the new one, but for parts of
/// figures that begin anew. Returns the reason why something cannot go on; empty if all does.
std::string keep_changes(const Replacement& worlds, Renamed& renamed);

} // namespace sinew

#pragma once

#include "sinew/prefab/character.h"
#include "sinew/prefab/controls.h"
#include "sinew/world/world.h"

namespace sinew {

/// Contact of a character with the ground, or with the rope or plank that it holds.
struct Footing {
    bool on_ground = false;
    bool is_holding = false;
    FigureIndex figure = no_figure; ///< the ground's, or the held one's; no_figure: a collider, a plane, or nothing
};

/// Moves a character in the step that follows: called once before each, with the length of the step. Everything is
/// worked out from the world, so copies, snapshots and replays go on alike. No effect on a figure without particles
/// feet and head, and in classic mode.
///
/// On the ground it walks along the surface, at a speed relative to whatever carries it, and what carries it feels the
/// opposite force; at rest it stands by friction. A riser no higher than `step_height` with ground behind it counts as
/// ground. What it holds, it holds by one or two distances called "hold", which shorten and lengthen as it climbs.
/// Taking hold and letting go allocate memory, as other edits do; walking does not.
///
///     walk(world, hero, character, {.along = 1, .jump = pressed}, 1.0 / 60);
///     simulation.step(1.0 / 60);
template <class Real>
Footing walk(World<2, Real>& world, FigureIndex figure, const Character& character, const Controls& controls, Real dt);

/// Footing after the last step, without moving anything.
template <class Real>
Footing footing_of(const World<2, Real>& world, FigureIndex figure, const Character& character, Real dt);

} // namespace sinew

#pragma once

#include "sinew/scene/scene.h"

#include <string>

namespace sinew {

/// Worlds of one figure each, by the old description and by the new one.
struct Descriptions {
    const AnyWorld& before;
    const AnyWorld& after;
};

/// Gives a running figure the numbers and the looks in which two descriptions differ, and moves, turns or scales the
/// figure by the similarity between both. Velocities stay, and all ids hold. Returns the reason for a change that only
/// a new figure could show, and then changes nothing; empty if all is done.
std::string change_figure(AnyWorld& world, FigureIndex figure, const Descriptions& descriptions);

} // namespace sinew

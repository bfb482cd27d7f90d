#pragma once

#include "sinew/scene/scene.h"

namespace sinew {

/// Classic mode's wide pointer, as in the tearable curtain: every movable particle within `radius` of the pointer's
/// path gets the pointer's velocity times `haste`; nothing is held.
struct Stroke {
    Point at;          ///< present position
    double radius = 0; ///< radius around the path, the scene's unit of length
    double haste = 1;  ///< factor on the pointer's velocity

    /// State of a snapshot.
    template <class Self, class Visit> static void state(Self& self, Visit&& visit) {
        auto& [position, radius, haste] = self;
        visit(position, radius, haste);
    }

    /// Moves to `to` within one frame.
    void go(AnyWorld& world, const Point& to);
};

/// True if a pointer of radius `radius` strokes instead of grabbing: classic mode with a positive radius.
bool strokes(const AnyWorld& world, double radius);

} // namespace sinew

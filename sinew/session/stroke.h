#pragma once

#include "sinew/scene/scene.h"

namespace sinew {

/// Classic mode's wide pointer, as the tearable curtain had it: it takes hold of nothing, but all that it comes near to
/// on its way goes as fast as it does, or so many times as fast.
struct Stroke {
    Point at;         ///< where it is
    double reach = 0; ///< how near to its way
    double haste = 1; ///< times its own speed

    /// One frame's way.
    void go(AnyWorld& world, const Point& to);
};

/// Whether a pointer that reaches so far strokes instead of holding.
bool strokes(const AnyWorld& world, double reach);

} // namespace sinew

#pragma once

#include "sinew/scene/driver_section.h"

namespace sinew {

/// Where a driver has its pin at a time. `rest` is where the pin is held without it; `up` is -1 where y points down.
Point driven_to(const Driver& driver, const Point& rest, double time, int up);

/// Goes after a pointer, frame by frame: v = v (1 - damping) + share (goal - x), x += v (GameMaker); between frames
/// straight on.
struct Seeker {
    Point at{}, before{}, speed{};
    double frames = 0; ///< how many are done

    /// Where it is when so many frames are over.
    Point follow(const Point& goal, double frame, const PointerDriver& driver);
};

} // namespace sinew

#pragma once

namespace sinew {

/// Wishes of a player for a figure that can be steered, for the next step.
struct Controls {
    double along = 0;  ///< [-1, 1]: a character walks, a car drives, to the left or to the right
    double up = 0;     ///< [-1, 1]: a character climbs what it holds; a car in the air lifts its front
    bool jump = false; ///< a character jumps off the ground; a car brakes
    bool hold = false; ///< a character reaches for a rope or a plank, and holds on to it

    friend bool operator==(const Controls&, const Controls&) = default;
};

} // namespace sinew

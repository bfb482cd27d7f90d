#pragma once

#include "sinew/math/vec.h"

namespace sinew::collide {

/// Part of a segment above a flat face of a convex solid: both ends of it are contacts of a rod that lies on the face.
template <int D, class Real> struct SegmentOverFace {
    /// Cosine of the angle between a contact's normal and the face's from which they differ: 25 degrees.
    static constexpr Real least_slope = Real(0.9);
    Vec<D, Real> normal{};  ///< of the face
    Real offset = 0;        ///< of the face: dot(normal, x)
    Real low = 0, high = 1; ///< parameters on the segment; low > high for nothing

    /// Keeps the part where a linear function of the parameter, with these values at the ends, is not negative.
    void clip(Real at_low, Real at_high) {
        if (at_low < Real(0)) low = at_high > Real(0) ? max(low, at_low / (at_low - at_high)) : Real(2);
        if (at_high < Real(0)) high = at_low > Real(0) ? min(high, at_low / (at_low - at_high)) : Real(-1);
    }
};

} // namespace sinew::collide

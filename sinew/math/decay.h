#pragma once

#include "sinew/math/trig.h"

namespace sinew {

/// Factors of drag over a time: of a velocity, and of the velocity gained by a constant push.
///
///     keep = exp(-rate time)      yield = (1 - exp(-rate time)) / (rate time)
template <class Real> struct Decay {
    Real rate = 0;
    Real keep = 1, yield = 1;

    static Decay of(Real rate, Real time) {
        const double turns = double(rate) * double(time);
        if (turns < 1e-12) return {rate, Real(1), Real(1)};
        const double keep = exponential(-turns);
        return {rate, Real(keep), Real((1 - keep) / turns)};
    }
};

} // namespace sinew

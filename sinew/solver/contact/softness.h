#pragma once

#include "sinew/math/scalar.h"

namespace sinew::detail {

/// Share of a violation removed in a substep, and of the multiplier applied and taken back: a damped spring, by
/// implicit Euler (Catto 2011). Stiffer than 1/12 of the substeps' frequency a stack never rests.
template <class Real> struct Softness {
    Real rate = 0, mass = 1, impulse = 0;

    /// `load`: mass that the spring carries, a part of the mass moved by the row.
    static constexpr Softness contact(Real load = 1) {
        constexpr Real turn = Real(2) * pi<Real> / Real(12), damping = Real(10);
        constexpr Real a1 = Real(2) * damping + turn;
        const Real a2 = turn * a1 * load, a3 = Real(1) / (Real(1) + a2);
        return {turn / a1, a2 * a3, a3};
    }
    static constexpr Softness hard() { return {1, 1, 0}; }
    /// Velocities alone: nothing is pushed out.
    static constexpr Softness none() { return {0, 1, 0}; }
};

/// Next multiplier of a row gap + change >= 0; it is soft while the gap is closed. `mass`: 1 / response of the change.
template <class Real>
Real one_sided_multiplier(Real multiplier, Real mass, Real change, Real gap, const Softness<Real>& soft) {
    const bool is_open = gap > Real(0);
    const Real bias = is_open ? gap : soft.rate * gap;
    const Real share = is_open ? Real(1) : soft.mass, back = is_open ? Real(0) : soft.impulse;
    return max(multiplier - mass * share * (change + bias) - back * multiplier, Real(0));
}

/// Next multiplier of a row error + change = 0.
template <class Real>
Real two_sided_multiplier(Real multiplier, Real mass, Real change, Real error, const Softness<Real>& soft) {
    return multiplier - mass * soft.mass * (change + soft.rate * error) - soft.impulse * multiplier;
}

} // namespace sinew::detail

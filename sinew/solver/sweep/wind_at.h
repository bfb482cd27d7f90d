#pragma once

#include "sinew/math/random.h"
#include "sinew/world/world.h"

#include <cmath>

namespace sinew {

/// Smooth noise in [-1, 1]: random values at whole t, interpolated by 3 s^2 - 2 s^3; a stream per component.
template <class Real> Real noise(double t, std::uint64_t seed, std::uint64_t stream) {
    const double whole = std::floor(t);
    const auto n = std::uint64_t(std::int64_t(whole));
    const Real s = Real(t - whole);
    const Real before = random::symmetric<Real>(seed, stream, n), after = random::symmetric<Real>(seed, stream, n + 1);
    return before + (after - before) * (s * s * (Real(3) - Real(2) * s));
}

/// Velocity of the air at a position and time.
template <int D, class Real>
Vec<D, Real> wind_at(const Wind<D, Real>& wind, const Vec<D, Real>& position, double time) {
    constexpr double max = 1e15; // gusts: beyond, a double cannot resolve single gusts
    const double behind = double(dot(position, direction(wind.velocity)) * inverse_or_zero(wind.gust_size));
    const double t = clamp(time * inverse_or_zero(double(wind.gust_period)), -max, max) - clamp(behind, -max, max);
    const auto gust =
        Vec<D, Real>::map([&](int i) { return wind.gust[i] * noise<Real>(t, wind.seed, std::uint64_t(i)); });
    return clamp_components(wind.velocity + gust, limit::speed<Real>);
}

} // namespace sinew

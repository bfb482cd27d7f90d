#pragma once

#include "sinew/math/vec.h"
#include "sinew/solver/id.h"

#include <cstdint>
#include <variant>

/// Force fields: what acts on every particle at a place and a time. Any number of them, summed.
namespace sinew {

/// Everything falls alike.
template <int D, class Real> struct Gravity { Vec<D, Real> acceleration{}; };

/// Still air or water: F = -strength v.
template <int D, class Real> struct Drag {
    Real strength = 0; ///< force over speed
};

/// Moving air: F = strength (u - v), where u = velocity + gust * noise. The noise is smooth in time, travels with the
/// wind, lies in [-1, 1] and is a pure function of the seed.
template <int D, class Real> struct Wind {
    Vec<D, Real> velocity{};
    Real strength = 0;    ///< force over speed
    Vec<D, Real> gust{};  ///< largest change of velocity in a gust
    Real gust_period = 1; ///< time between one gust and the next
    Real gust_size = 0;   ///< length of a gust along the wind; 0: everywhere at once
    std::uint64_t seed = 0;
};

/// Pulls towards a point, pushes if strength is negative: a = -strength d / (|d|^2 + softness^2)^(3/2), d = x - center:
/// as 1/r^2 far away, as a spring near by, never singular (Plummer 1911).
template <int D, class Real> struct Attractor {
    Vec<D, Real> center{};
    Real strength = 0;              ///< acceleration times length squared
    Real softness = 1;              ///< length
    FigureIndex figure = no_figure; ///< the only one whose particles are pulled; no_figure: all are
};

template <int D, class Real> constexpr bool pulls(const Attractor<D, Real>& attractor, FigureIndex figure) {
    return attractor.figure == no_figure || attractor.figure == figure;
}

/// Each step, one particle chosen at random gets a force whose components are whole numbers from low to high (Roblox
/// wind).
template <int D, class Real> struct RandomPush {
    Vec<D, Real> low{}, high{};
    std::uint64_t seed = 0;
};

template <int D, class Real>
using Force = std::variant<Gravity<D, Real>, Drag<D, Real>, Wind<D, Real>, Attractor<D, Real>, RandomPush<D, Real>>;

} // namespace sinew

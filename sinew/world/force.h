#pragma once

#include "sinew/math/vec.h"
#include "sinew/table/id.h"

#include <cstdint>
#include <variant>

/// Force fields, functions of a particle's position and the time. Any number of fields add up.
namespace sinew {

/// Uniform acceleration.
template <int D, class Real> struct Gravity {
    Vec<D, Real> acceleration{};
    friend constexpr bool operator==(const Gravity&, const Gravity&) = default;
};

/// Still air or water: F = -strength v.
template <int D, class Real> struct Drag {
    Real strength = 0; ///< force per velocity
    friend constexpr bool operator==(const Drag&, const Drag&) = default;
};

/// Moving air: F = strength w, w = u - v, on each particle, where u = velocity + gust * noise. The noise is smooth in
/// time, travels with the wind, lies in [-1, 1] and is a pure function of the seed. In physical mode it acts on cloth
/// by its area, across it, strength for each 0.01 m^2. With a density it presses on what it meets, too: F = 1/2 density
/// drag_coefficient A |w| w.
template <int D, class Real> struct Wind {
    Vec<D, Real> velocity{};
    Real strength = 0;    ///< force per velocity
    Vec<D, Real> gust{};  ///< largest change of velocity in a gust
    Real gust_period = 1; ///< time between gusts
    Real gust_size = 0;   ///< length of a gust along the wind; 0: everywhere at once
    std::uint64_t seed = 0;
    Real density = 0; ///< mass / length^3: above 0 the wind presses on areas, lines and balls (solver/step/wind.cpp)
    Real drag_coefficient = Real(1.2); ///< of those, >= 0: 1.2 for a plate
    Real metre = 1;                    ///< length; 2D: of lines and balls across the picture
    friend constexpr bool operator==(const Wind&, const Wind&) = default;
};

/// Attraction to a point, repulsion if strength is negative: a = -strength d / (|d|^2 + softness^2)^(3/2), d = x -
/// center: 1/r^2 far away, linear near the centre, never singular (Plummer 1911).
template <int D, class Real> struct Attractor {
    Vec<D, Real> center{};
    Real strength = 0;              ///< acceleration times length squared
    Real softness = 1;              ///< length
    FigureIndex figure = no_figure; ///< pulls the particles of this figure only; no_figure: all
    friend constexpr bool operator==(const Attractor&, const Attractor&) = default;
};

template <int D, class Real> constexpr bool pulls(const Attractor<D, Real>& attractor, FigureIndex figure) {
    return attractor.figure == no_figure || attractor.figure == figure;
}

/// Each step, a random particle gets a force whose components are random integers in [low, high] (Roblox wind).
template <int D, class Real> struct RandomPush {
    Vec<D, Real> low{}, high{};
    std::uint64_t seed = 0;
    friend constexpr bool operator==(const RandomPush&, const RandomPush&) = default;
};

template <int D, class Real>
using Force = std::variant<Gravity<D, Real>, Drag<D, Real>, Wind<D, Real>, Attractor<D, Real>, RandomPush<D, Real>>;

} // namespace sinew

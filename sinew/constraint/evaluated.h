#pragma once

#include "sinew/math/vec.h"

#include <array>
#include <cstdint>
#include <limits>

/// What a constraint kind is: a struct that measures a few particles and knows the measure's gradient.
///
///     name              what scene files call it
///     arity             how many particles; any_arity for as many as a constraint was given
///     dimensions        {lowest, highest} dimension it exists in
///     length_power      how the measure grows with size: 1 a length, 2 an area, 3 a volume, 0 an angle
///     period            for angles: a whole turn; 0 for the rest
///     sided             optional: true if it changes its sign in a mirror though its length_power and period do not
///                       say so
///     invariant         optional: false if moving or turning all particles together changes the measure; such a
///                       constraint joins its particles to the world, and may take momentum
///     drawn_as          optional: a line through its particles, or a fill between them; else it is not drawn
///     evaluate(points)  the measure and its gradient with respect to each point
///
/// The scalar T is open: one number, a pack of lanes, or a dual number in tests. Degenerate points (coincident,
/// collinear) give a zero gradient, never NaN; the solver knows what to do then.
namespace sinew {

inline constexpr int any_arity = 0;

struct Dimensions {
    int lowest = 2, highest = 3;
    constexpr bool include(int d) const { return lowest <= d && d <= highest; }
};

enum class DrawnAs : std::uint8_t { nothing, line, fill };

/// The optional members of a kind, with their defaults.
template <class Kind>
inline constexpr bool is_invariant = [] {
    if constexpr (requires { Kind::invariant; }) return bool(Kind::invariant);
    return true;
}();
template <class Kind>
inline constexpr DrawnAs is_drawn_as = [] {
    if constexpr (requires { Kind::drawn_as; }) return DrawnAs(Kind::drawn_as);
    return DrawnAs::nothing;
}();

template <int N, int D, class T> using Points = std::array<Vec<D, T>, N>;

template <int N, int D, class T> struct Evaluated {
    T value{};
    Points<N, D, T> gradient{};
};

} // namespace sinew

#pragma once

#include "sinew/math/vec.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

/// A constraint kind is a struct that measures a few particles and gives the gradient of the measure.
///
///     name              name in scene files
///     arity             number of particles; any_arity where each constraint has its own number
///     dimensions        {lowest, highest} dimension the kind exists in
///     length_power      power of length in the measure: 1 a length, 2 an area, 3 a volume, 0 an angle
///     period            a whole turn for periodic angles; 0 otherwise
///     sided             optional: true if mirroring flips the sign although length_power and period do not imply so
///     never_negative    optional: true for a length
///     invariant         optional: false if a rigid motion of all particles changes the measure; such a constraint
///                       ties its particles to the world and need not conserve momentum
///     drawn_as          optional: a line through the particles, or a filled polygon; not drawn by default
///     manual            optional: the definition for people, in the reference and `sinew describe KIND`
///     evaluate(points)  the measure, and its gradient with respect to each point
///
/// The scalar type T is open: a number, a SIMD pack, or a dual number in tests. Degenerate points (coincident,
/// collinear) give a zero gradient, never NaN; the solver skips a constraint without a gradient.
namespace sinew {

inline constexpr int any_arity = 0;

struct Dimensions {
    int lowest = 2, highest = 3;
    constexpr bool include(int d) const { return lowest <= d && d <= highest; }
};

/// Definition of a kind for people. Units follow from its length_power.
struct KindManual {
    std::string_view about{};     ///< a sentence
    std::string_view drawing{};   ///< lines of text
    std::string_view particles{}; ///< meaning of each one, in order
    std::string_view zero{};      ///< where the measure is 0
    std::string_view sign{};      ///< which way it grows, and its range
    std::string_view use{};       ///< use of rest, low and high
    std::string_view example{};   ///< JSON of a constraint
};

enum class DrawnAs : std::uint8_t { nothing, line, fill };

/// Optional members of a kind, with their defaults.
template <class Kind>
inline constexpr bool is_invariant = [] {
    if constexpr (requires { Kind::invariant; }) return bool(Kind::invariant);
    return true;
}();
template <class Kind>
inline constexpr bool is_never_negative = [] {
    if constexpr (requires { Kind::never_negative; }) return bool(Kind::never_negative);
    return false;
}();
template <class Kind>
inline constexpr DrawnAs is_drawn_as = [] {
    if constexpr (requires { Kind::drawn_as; }) return DrawnAs(Kind::drawn_as);
    return DrawnAs::nothing;
}();

template <class Kind>
inline constexpr KindManual manual_of = [] {
    if constexpr (requires { Kind::manual; }) return KindManual(Kind::manual);
    return KindManual{};
}();

template <int N, int D, class T> using Points = std::array<Vec<D, T>, N>;

template <int N, int D, class T> struct Evaluated {
    T value{};
    Points<N, D, T> gradient{};
};

} // namespace sinew

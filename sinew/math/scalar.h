#pragma once

#include <cmath>
#include <concepts>
#include <limits>

/// Scalar helpers that give the same bits on every machine: only +, -, *, /, sqrt and comparisons, which IEEE 754
/// rounds in exactly one way. No function here calls a libm function whose result depends on the platform.
namespace sinew {

template <std::floating_point T> inline constexpr T pi = T(3.14159265358979323846L);

/// An instruction, also in sources compiled without optimization, whose copies the linker may prefer.
template <std::floating_point T> [[gnu::always_inline]] inline T square_root(T x) {
    return std::sqrt(x);
}

template <class T> constexpr T min(T a, T b) {
    return b < a ? b : a;
}

template <class T> constexpr T max(T a, T b) {
    return a < b ? b : a;
}

/// x clamped to [low, high]. NaN becomes low, so the result is always finite for finite bounds.
template <class T> constexpr T clamp(T x, T low, T high) {
    return min(high, max(low, x));
}

template <class T> constexpr T absolute(T x) {
    return max(x, -x); // no branch
}

template <class T> constexpr T square(T x) {
    return x * x;
}

/// 1/x, or 0 where x is zero, negative or so small that 1/x would overflow. Every division in a constraint goes through
/// this guard.
template <std::floating_point T> constexpr T inverse_or_zero(T x) {
    return x >= std::numeric_limits<T>::min() ? T(1) / x : T(0);
}

template <std::floating_point T> constexpr bool is_finite(T x) {
    return x - x == T(0);
}

} // namespace sinew

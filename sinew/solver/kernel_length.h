#pragma once

#include "sinew/math/lane.h"

#include <type_traits>

/// How much longer what has a length must become. Most of what is held at a length is near it; there a short series is
/// as good as a root and a quotient, which take as long as all the rest of a correction.
namespace sinew {
namespace {

using namespace lane;

/// 1 / length^2, which is finite.
template <class V> [[gnu::always_inline]] inline V per_square(const V& length) {
    using Real = std::decay_t<decltype(lane_of(length, 0))>;
    return least(Real(1) / (length * length), spread<V>(Real(1e30)));
}

/// The square of a length that is much too long, as a part of the square of what it should be.
template <class Real> inline constexpr Real strained = Real(1.02 * 1.02);

/// 1 / sqrt(t) - 1, where t is the square of a length as a part of the square of what it should be. Notes whether any
/// is much too long.
///
///     1/sqrt(1 - h) - 1 = h/2 + 3/8 h^2 + 5/16 h^3 + 35/128 h^4 + ...
///
template <class V> [[gnu::always_inline]] inline V lacking(const V& t, bool& any_strained) {
    using Real = std::decay_t<decltype(lane_of(t, 0))>;
    constexpr Real near = Real(1.0 / 32);
    const V h = Real(1) - t;
    V by = spread<V>(Real(0.3125));
    if constexpr (sizeof(Real) == 8) by = by + h * (Real(35.0 / 128) + h * Real(63.0 / 256));
    by = h * (Real(0.5) + h * (Real(0.375) + h * by));
    const auto far = !(h * h < spread<V>(near * near));
    if (any(far)) [[unlikely]] {
        by = far ? Real(1) / root(most(t, spread<V>(Real(1e-30)))) - Real(1) : by;
        any_strained = any_strained || any(t > spread<V>(strained<Real>));
    }
    return by;
}
template <class V> [[gnu::always_inline]] inline V lacking(const V& t) {
    bool nobody_asks = false;
    return lacking(t, nobody_asks);
}

} // namespace
} // namespace sinew

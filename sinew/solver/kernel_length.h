#pragma once

#include "sinew/math/lane.h"

#include <type_traits>

/// How much longer what has a length must become, as a part of what it is: 1 / sqrt(t) - 1, where t is the square of
/// its length as a part of the square of what it should be.
namespace sinew {
namespace {

using namespace lane;

/// The square of a length that is much too long, as a part of the square of what it should be.
template <class Real> inline constexpr Real strained = Real(1.02 * 1.02);

/// `part` of that, of which the tangent at t = 1 is known: part (1 - t) / 2. Most of what is held at a length is near
/// it; there the tangent is as good as a root and a quotient, which take as long as all the rest of a correction: it
/// overshoots by at most 2.4 % of the way.
template <class V, class Real, class Square>
[[gnu::always_inline]] inline V lacking(const V& tangent, Real part, Square&& square) {
    const V near = spread<V>(part / 64), away = tangent * tangent;
    if (any_less(near * near, away)) [[unlikely]] {
        const V exactly = part / root(most(square(), spread<V>(Real(1e-30)))) - part;
        return near * near < away ? exactly : tangent;
    }
    return tangent;
}

} // namespace
} // namespace sinew

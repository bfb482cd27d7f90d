#pragma once

#include "sinew/math/lane.h"

#include <type_traits>

/// Relative correction of a length: 1 / sqrt(t) - 1, where t = length^2 / limit^2.
namespace sinew {
namespace {

using namespace lane;

/// `part` times the relative correction, given the tangent at t = 1: part (1 - t) / 2. Most lengths are near their
/// limit, where the tangent is within 2.4 % of the correction and saves a root and a quotient, as costly as all the
/// rest.
template <class V, class Real, class Square>
[[gnu::always_inline]] inline V lacking(const V& tangent, Real part, Square&& square) {
    const V near = spread<V>(part / 64), away = tangent * tangent;
    if (any_less(near * near, away)) [[unlikely]] {
        const V exactly = part / root(max(square(), spread<V>(Real(1e-30)))) - part;
        return near * near < away ? exactly : tangent;
    }
    return tangent;
}

} // namespace
} // namespace sinew

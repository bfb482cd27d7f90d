#pragma once

#include "sinew/math/limit.h"
#include "sinew/world/stencil.h"

#include <array>

namespace sinew::detail {

/// A bending spring fades with legs shorter than their fading lengths (world/slack_links.h; 0: none): its violation is
/// multiplied by leg / length, its energy by the square, and the gradient is that of the product. The direction of a
/// leg of no length then matters to nothing. False if both legs are long enough.
template <class Stencil, class Real>
bool fade_bend(Stencil& stencil, const std::array<Real, 2>& lengths, Real low, Real high, Real& measure) {
    using Vector = std::decay_t<decltype(stencil.points[0])>;
    std::array<Real, 2> share{1, 1};
    std::array<Vector, 2> slope{};
    for (std::size_t i = 0; i < 2; ++i) {
        const auto leg = stencil.points[i + 1] - stencil.points[i];
        const Real now = norm(leg);
        if (!(now < lengths[i])) continue;
        share[i] = now / lengths[i];
        slope[i] = direction(leg) * (Real(1) / lengths[i]);
    }
    const Real whole = share[0] * share[1];
    if (whole == Real(1)) return false;
    const Real nearest = clamp(measure, low, high), error = measure - nearest;
    for (auto& gradient : stencil.gradient) gradient *= whole;
    for (std::size_t i = 0; i < 2; ++i) {
        const auto along = slope[i] * (error * share[1 - i]);
        stencil.gradient[i] -= along, stencil.gradient[i + 1] += along;
    }
    measure = nearest + error * whole;
    return true;
}

/// Share of a change of a bend's multiplier that turns no leg by more than the tangents of its ends stand for the arc:
/// beyond, a leg would grow with each correction. 1 where the change is small enough.
template <class Stencil, class Mover, class Real>
Real share_of_turn(const Stencil& stencil, const Mover& mover, std::span<const Row> members, Real change) {
    constexpr Real furthest = Real(0.1); // radians; a leg then grows by half a hundredth
    Real share = 1;
    for (std::size_t i = 0; i < 2; ++i) {
        const Row from = members[i], to = members[i + 1];
        const auto moved = stencil.direction[i + 1] * mover.weight(to) - stencil.direction[i] * mover.weight(from);
        const Real by = norm(moved) * absolute(change), most = furthest * distance(mover.point(from), mover.point(to));
        if (by > most) share = min(share, most / by);
    }
    return share;
}

} // namespace sinew::detail

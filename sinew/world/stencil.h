#pragma once

#include "sinew/world/world.h"

#include <span>
#include <utility>
#include <vector>

/// Value and gradient of one constraint at given points, and its distance from its limits.
namespace sinew::detail {

/// Gradient, clamped so that the square fits a float: the gradient of an angle grows without bound as the legs shrink.
template <class Kind, int D, class Real> Vec<D, Real> gentle(const Vec<D, Real>& gradient) {
    return Kind::length_power > 0 ? gradient : clamp_components(gradient, Real(1e15));
}

/// Room for one constraint's points and gradients, in `scratch` where the kind has no fixed arity. `each` visits the
/// members; for a fixed arity the loop is unrolled, and the stencil lives in registers.
template <class Kind, int D, class Real> struct Stencil {
    Points<Kind::arity, D, Real> points, gradient, direction;

    Stencil(std::span<Vec<D, Real>>, std::size_t) {}
    template <class Visit> static void each(Visit&& visit) {
        [&]<std::size_t... I>(std::index_sequence<I...>) {
            (visit(I), ...);
        }
        (std::make_index_sequence<std::size_t(Kind::arity)>{});
    }
    static Real evaluate(const Points<Kind::arity, D, Real>& x, Points<Kind::arity, D, Real>& gradient) {
        const auto evaluated = Kind::evaluate(x);
        each([&](std::size_t i) { gradient[i] = gentle<Kind>(evaluated.gradient[i]); });
        return evaluated.value;
    }
};

template <class Kind, int D, class Real>
requires(Kind::arity == any_arity) struct Stencil<Kind, D, Real> {
    std::span<Vec<D, Real>> points, gradient, direction;

    Stencil(std::span<Vec<D, Real>> scratch, std::size_t n)
        : points(scratch.subspan(0, n)), gradient(scratch.subspan(n, n)), direction(scratch.subspan(2 * n, n)) {}
    template <class Visit> void each(Visit&& visit) const {
        for (std::size_t i = 0; i < points.size(); ++i) visit(i);
    }
    static Real evaluate(std::span<Vec<D, Real>> x, std::span<Vec<D, Real>> gradient) {
        return Kind::evaluate(std::span<const Vec<D, Real>>(x), gradient);
    }
};

/// Sizes the scratch of stencils for the widest constraint.
template <int D, class Real>
void make_room_for_widest(const World<D, Real>& world, std::vector<Vec<D, Real>>& scratch) {
    std::size_t widest = 0;
    for_each_table(world, [&]<class Table>(const Table& table) {
        if constexpr (Table::Kind::arity == any_arity)
            for (Row row = 0; row < table.size(); ++row) widest = std::max(widest, table.members[row].size());
    });
    if (scratch.size() < 3 * widest) scratch.resize(3 * widest);
}

/// Measure of an angle modulo a whole turn: the value nearest to the middle of the limits; with one limit, to the value
/// within the limits that is nearest to 0. Other measures are unchanged.
template <class Kind, class Real> Real unwrap(Real measure, Real low, Real high) {
    if constexpr (Kind::period > 0) {
        constexpr Real turn = Real(Kind::period), far = Real(1e5) * turn; // of no use beyond: rounding
        const bool has_both = low >= -far && high <= far;
        const Real middle = has_both ? Real(0.5) * (low + high) : clamp(clamp(Real(0), low, high), -far, far);
        return measure - turn * std::floor((measure - middle) / turn + Real(0.5));
    } else {
        return measure;
    }
}

/// True for limits that a measure can have. Angles in space have no sign, lengths are never negative.
template <class Kind, class Real> bool are_possible(Real low, Real high) {
    if constexpr (std::is_same_v<Kind, Angle<3>>)
        return high >= Real(0) && (low >= Real(0) || low <= -limit::measure<float>);
    return !is_never_negative<Kind> || max(low, high) >= Real(0); // reversed limits are held at the lower
}

/// Violation of the limits as a fraction of the violated limit; the violation itself for an angle, and for a limit of
/// zero, which has no fractions.
template <class Kind, class Real> Real strain(Real measure, Real low, Real high) {
    const Real unwrapped = unwrap<Kind>(measure, low, high);
    const Real nearest = clamp(unwrapped, low, high);
    const bool is_relative = Kind::length_power > 0 && nearest != Real(0);
    return (unwrapped - nearest) * inverse_or_zero(is_relative ? absolute(nearest) : Real(1));
}

} // namespace sinew::detail

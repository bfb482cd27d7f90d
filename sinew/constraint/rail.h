#pragma once

#include "sinew/constraint/evaluated.h"
#include "sinew/math/scalar.h"

namespace sinew {

/// Signed distance of the particle p from the line through a and b, positive to the left of the direction a -> b where
/// y is up. A rest value of 0 is a slider on a rail; limits make a slot.   u = (b - a) / |b - a|
///
///     C = u x (p - a)        t = u . (p - a) / |b - a|
///     dC/dp = perp(u)        dC/da = -(1 - t) perp(u)        dC/db = -t perp(u)
///
/// The parameter t is clamped to +-1e6, which matters where a and b nearly coincide.
template <int D> struct Rail {
    static constexpr auto name = "rail";
    static constexpr int arity = 3;
    static constexpr Dimensions dimensions{2, 2};
    static constexpr int length_power = 1;
    static constexpr double period = 0;
    static constexpr bool sided = true;
    static constexpr KindManual manual{
        .about = "Distance of a particle from the line through two others, with a sign: a slider.",
        .drawing = "               p o\n"
                   "                 |  C\n"
                   "    a o----------+--------o b\n",
        .particles = "a, b, p: two points of the rail, then the slider",
        .zero = "where p is on the line, also beyond a or b",
        .sign = "positive to the left of the direction a -> b on a screen with y up (to the right with "
                "\"up\": \"-y\")",
        .use = "rest 0: a slider on a rail; low and high: a slot",
        .example = "{\"kind\": \"rail\", \"between\": [\"a\", \"b\", \"p\"], \"rest\": 0}"};

    template <class T> static Evaluated<3, 2, T> evaluate(const Points<3, 2, T>& x) {
        const auto ab = x[1] - x[0], ap = x[2] - x[0];
        const auto u = direction(ab), n = perpendicular(u);
        const T t = clamp(dot(u, ap) * inverse_or_zero(norm(ab)), T(-1e6), T(1e6));
        return {cross(u, ap), {-n * (T(1) - t), -n * t, n}};
    }
};

} // namespace sinew

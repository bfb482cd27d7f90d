#pragma once

#include "sinew/constraint/evaluated.h"

namespace sinew {

/// Distance between two particles.            C = |b - a|
template <int D> struct Distance {
    static constexpr auto name = "distance";
    static constexpr int arity = 2;
    static constexpr Dimensions dimensions{2, 3};
    static constexpr int length_power = 1;
    static constexpr double period = 0;
    static constexpr bool never_negative = true;
    static constexpr auto drawn_as = DrawnAs::line;
    static constexpr KindManual manual{.about = "Distance between two particles: a rod, a rope or a spring.",
                                       .drawing = "    a o---------------------o b\n"
                                                  "      |<-------- C -------->|\n",
                                       .particles = "a, b: the ends, in either order",
                                       .zero = "where both are at one place",
                                       .sign = "never negative",
                                       .use = "rest: a rod; high: a rope; low: a strut; compliance: a spring",
                                       .example = "{\"kind\": \"distance\", \"between\": [\"a\", \"b\"], \"rest\": 1}"};

    template <class T> static Evaluated<2, D, T> evaluate(const Points<2, D, T>& x) {
        const auto ab = x[1] - x[0];
        const T length = norm(ab);
        const auto n = ab * inverse_or_zero(length);
        return {length, {-n, n}};
    }
};

} // namespace sinew

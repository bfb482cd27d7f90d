#pragma once

#include "sinew/constraint/evaluated.h"

namespace sinew {

/// Signed volume of the tetrahedron a b c d.            C = (b - a) . ((c - a) x (d - a)) / 6
template <int D> struct Volume {
    static constexpr auto name = "volume";
    static constexpr int arity = 4;
    static constexpr Dimensions dimensions{3, 3};
    static constexpr int length_power = 3;
    static constexpr double period = 0;
    static constexpr KindManual manual{
        .about = "Volume of a tetrahedron, (b - a) . ((c - a) x (d - a)) / 6.",
        .drawing = "            d o\n"
                   "             /|\\\n"
                   "            / | \\\n"
                   "           /  o c\\\n"
                   "          / .   . \\\n"
                   "       a o---------o b\n",
        .particles = "a, b, c, d: the corners; two of them exchanged change the sign",
        .zero = "where the four are in one plane",
        .sign = "positive where d is on the side from which a, b, c run counter-clockwise",
        .use = "rest: jelly; low: 0: a joint that bends to one side only",
        .example = "{\"kind\": \"volume\", \"between\": [\"a\", \"b\", \"c\", \"d\"], \"compliance\": 1e-5}"};

    template <class T> static Evaluated<4, 3, T> evaluate(const Points<4, 3, T>& x) {
        constexpr auto sixth = T(1.0 / 6);
        const auto ab = x[1] - x[0], ac = x[2] - x[0], ad = x[3] - x[0];
        const auto db = cross(ac, ad) * sixth, dc = cross(ad, ab) * sixth, dd = cross(ab, ac) * sixth;
        return {dot(ab, db), {-(db + dc + dd), db, dc, dd}};
    }
};

} // namespace sinew

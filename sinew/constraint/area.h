#pragma once

#include "sinew/constraint/evaluated.h"

#include <span>

namespace sinew {

/// Signed area of a polygon, counter-clockwise positive in a y-up frame (shoelace formula).
///
///     C = 1/2 sum x_i x x_(i+1)          dC/dx_i = 1/2 perp(x_(i-1) - x_(i+1))
///
/// Coordinates are taken relative to the first point, so a polygon far from the origin keeps its precision.
template <int D> struct Area {
    static constexpr auto name = "area";
    static constexpr int arity = any_arity;
    static constexpr int min_arity = 3;
    static constexpr Dimensions dimensions{2, 2};
    static constexpr int length_power = 2;
    static constexpr double period = 0;
    static constexpr auto drawn_as = DrawnAs::fill;
    static constexpr KindManual manual{
        .about = "Area of a polygon through three particles or more.",
        .drawing = "      d o----------o c\n"
                   "       /            \\\n"
                   "      /      C       \\\n"
                   "   a o----------------o b\n",
        .particles = "the corners in order, all round",
        .zero = "where the corners are in line, or the parts of a figure of eight are equal",
        .sign = "positive where the corners run counter-clockwise on a screen with y up (clockwise with "
                "\"up\": \"-y\")",
        .use = "rest: a body that keeps its area, such as jelly; low: one that cannot be crushed",
        .example = "{\"kind\": \"area\", \"between\": [\"a\", \"b\", \"c\", \"d\"], \"compliance\": 1e-4}"};

    template <class T> static T evaluate(std::span<const Vec<2, T>> x, std::span<Vec<2, T>> gradient) {
        const auto n = x.size();
        T twice_area = T(0);
        for (std::size_t i = 0; i < n; ++i) {
            const auto &before = x[i == 0 ? n - 1 : i - 1], &after = x[i + 1 == n ? 0 : i + 1];
            twice_area = twice_area + cross(x[i] - x[0], after - x[0]);
            gradient[i] = perpendicular(before - after) * T(0.5);
        }
        return twice_area * T(0.5);
    }
};

} // namespace sinew

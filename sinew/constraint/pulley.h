#pragma once

#include "sinew/constraint/evaluated.h"

#include <span>

namespace sinew {

/// Length of the polyline through all particles: a rope that slides freely over every particle but the first and the
/// last.
///                       C = sum |x_(i+1) - x_i|
///
/// Three particles make a pulley. A rope that runs to a block and back is a tackle, with twice the force.
template <int D> struct Pulley {
    static constexpr auto name = "pulley";
    static constexpr int arity = any_arity;
    static constexpr int min_arity = 3;
    static constexpr Dimensions dimensions{2, 3};
    static constexpr int length_power = 1;
    static constexpr double period = 0;
    static constexpr bool never_negative = true;
    static constexpr auto drawn_as = DrawnAs::line;
    static constexpr KindManual manual{
        .about = "Length of the line through all particles in order: a rope that slides freely over all "
                 "but the first and the last.",
        .drawing = "         l o---------o r         C = |a l| + |l r| + |r b|\n"
                   "           |         |\n"
                   "           |         |\n"
                   "         a o         |\n"
                   "                   b o\n",
        .particles = "an end, the wheels in order, the other end. A wheel is a particle: pinned, or with a "
                     "load of its own (a block)",
        .zero = "where all are at one place",
        .sign = "never negative",
        .use = "high: a rope; rest: one that pushes, too; drive: a winch",
        .example = "{\"kind\": \"pulley\", \"between\": [\"a\", \"l\", \"r\", \"b\"], \"high\": 6}"};

    template <class T> static T evaluate(std::span<const Vec<D, T>> x, std::span<Vec<D, T>> gradient) {
        T length = T(0);
        gradient[0] = Vec<D, T>{};
        for (std::size_t i = 0; i + 1 < x.size(); ++i) {
            const auto leg = x[i + 1] - x[i];
            const T part = norm(leg);
            const auto n = leg * inverse_or_zero(part);
            length = length + part;
            gradient[i] = gradient[i] - n;
            gradient[i + 1] = n;
        }
        return length;
    }
};

} // namespace sinew

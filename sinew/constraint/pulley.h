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
    static constexpr auto drawn_as = DrawnAs::line;

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

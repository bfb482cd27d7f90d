#pragma once

#include "sinew/math/vec.h"

#include <array>
#include <cstddef>

namespace sinew::collide {

/// Cell of a grid that contains a point, as whole numbers; `per_size`: 1 / edge of a cell. Clamped to 1e9 cells.
template <class Int, int D, class Real> std::array<Int, D> cell_at(const Vec<D, Real>& point, Real per_size) {
    constexpr Real max = 1e9;
    std::array<Int, D> cell{};
    for (int i = 0; i < D; ++i) {
        const Real scaled = clamp(point[i] * per_size, -max, max);
        const auto towards_zero = Int(scaled);
        cell[std::size_t(i)] = towards_zero - (scaled < Real(towards_zero));
    }
    return cell;
}

} // namespace sinew::collide

#pragma once

#include "sinew/math/vec.h"

namespace sinew {

/// A point or a direction in a scene of 2 or 3 dimensions, where the dimension is known only at run time. The third
/// component is 0 in 2D.
struct Point {
    std::array<double, 3> component{};

    constexpr double& operator[](int i) { return component[std::size_t(i)]; }
    constexpr const double& operator[](int i) const { return component[std::size_t(i)]; }
    friend constexpr bool operator==(const Point&, const Point&) = default;

    template <int D, class T> constexpr Vec<D, T> as() const {
        return Vec<D, T>::map([this](int i) { return T((*this)[i]); });
    }
};

} // namespace sinew

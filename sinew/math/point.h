#pragma once

#include "sinew/math/vec.h"

namespace sinew {

/// A place or a direction in a scene of 2 or 3 dimensions, which is known only once the scene is read. In 2D the third
/// number stays 0.
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

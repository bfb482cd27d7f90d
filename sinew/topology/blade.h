#pragma once

#include "sinew/math/vec.h"

#include <functional>

namespace sinew {

/// A straight cut across a picture plane.
struct Blade {
    Vec2<double> from{}, to{};
    double radius = 0; ///< half thickness: links nearer to the blade are cut, too
};

/// Projection of a point to the picture plane; not finite where out of sight.
template <int D> using Projection = std::function<Vec2<double>(const Vec<D, double>&)>;

/// Orthographic projection along the third axis: (x, y).
template <int D> Vec2<double> along_z(const Vec<D, double>& position) {
    return {{position[0], position[1]}};
}

} // namespace sinew

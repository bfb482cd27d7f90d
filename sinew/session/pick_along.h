#pragma once

#include "sinew/math/point.h"
#include "sinew/world/world.h"

#include <limits>
#include <optional>

namespace sinew {

/// A particle near the way from one point to another.
struct PickedAlong {
    ParticleId particle;
    double share = 0; ///< of the way, where the particle is nearest, [0, 1]
};

/// The movable particle whose surface is nearest to a way, within `reach`; of several on the way the first one.
/// The way may be a single point. Distances as in the world.
template <int D, class Real>
std::optional<PickedAlong> pick_along(const World<D, Real>& world, const Point& from, const Point& to, double reach) {
    const auto start = from.as<D, double>(), along = to.as<D, double>() - start;
    const double square_length = dot(along, along);
    std::optional<PickedAlong> best;
    double nearest = std::numeric_limits<double>::infinity();
    const auto& p = world.particles;
    for (Row row = 0; row < p.size(); ++row) {
        if (!(p.mobility[row] > Real(0))) continue;
        const auto away = cast<double>(p.position[row]) - start;
        const double share = square_length > 0 ? clamp(dot(away, along) / square_length, 0.0, 1.0) : 0.0;
        const double gap = max(norm(away - along * share) - double(p.radius[row]), 0.0);
        if (!(gap <= reach) || gap > nearest || (gap == nearest && share >= best->share)) continue;
        nearest = gap;
        best = {p.handles.id_of(row), share};
    }
    return best;
}

} // namespace sinew

#include "sinew/session/focus.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace sinew {
namespace {

/// Two opposite corners of the scene's box, or of the particles' bounds with room to swing.
template <class WorldT> std::array<Point, 2> extent(const WorldT& world, const Scene& scene) {
    if (scene.world.bounds && scene.world.bounds->box) {
        auto corners = *scene.world.bounds->box;
        for (int i = 0; i < 3; ++i)
            if (corners[0][i] > corners[1][i]) std::swap(corners[0][i], corners[1][i]);
        return corners;
    }
    std::array<Point, 2> corners{};
    for (Row row = 0; row < world.particles.size(); ++row)
        for (int i = 0; i < WorldT::dimension; ++i) {
            const double x = double(world.particles.position[row][i]);
            corners[0][i] = row == 0 ? x : std::min(corners[0][i], x);
            corners[1][i] = row == 0 ? x : std::max(corners[1][i], x);
        }
    // hanging figures swing: room of half the larger side all around
    const double side = std::max(corners[1][0] - corners[0][0], corners[1][1] - corners[0][1]);
    for (int i = 0; i < 2; ++i) {
        corners[0][i] -= side * 0.5;
        corners[1][i] += side * 0.5;
    }
    return corners;
}

} // namespace

std::array<Point, 2> focus_of(const Scene& scene, const AnyWorld& world) {
    return std::visit([&](const auto& w) { return extent(w, scene); }, world);
}

} // namespace sinew

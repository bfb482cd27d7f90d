#include "sinew/session/focus.h"

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/shape.h"

#include <utility>
#include <variant>

namespace sinew {
namespace {

/// Room around the figures, as multiples of their longer side.
constexpr double swing_room = 0.5;   ///< hanging figures swing
constexpr double collider_range = 2; ///< a floor is seen that far: the whole of a wide one would make the figures small
constexpr double wall_range = 10; ///< whatever is thrown ends at a wall; with walls farther away the figures were dots

using Extent = collide::BoundingBox<3, double>;

Extent overlap_of(const Extent& a, const Extent& b) {
    return {Vec3<double>::map([&](int i) { return max(a.low[i], b.low[i]); }),
            Vec3<double>::map([&](int i) { return min(a.high[i], b.high[i]); })};
}

template <int D, class Real> Vec3<double> widened(const Vec<D, Real>& position) {
    return Vec3<double>::map([&](int i) { return i < D ? double(position[i]) : 0; });
}

template <class WorldT> Extent around_figures(const WorldT& world) {
    if (world.particles.size() == 0) return {{}, {}};
    Extent frame;
    for (Row row = 0; row < world.particles.size(); ++row) {
        const auto position = widened(world.particles.position[row]);
        const auto radius = Vec3<double>::map([&](int) { return double(world.particles.radius[row]); });
        frame.include(position - radius);
        frame.include(position + radius);
    }
    return frame;
}

Extent around_room(const std::array<Point, 2>& corners) {
    Extent frame;
    for (const auto& corner : corners) frame.include(corner.as<3, double>());
    return frame;
}

/// The scene's box as far as it is near the figures; without one, the figures with the colliders near them.
template <class WorldT> Extent shown_part(const WorldT& world, const Scene& scene) {
    const auto figures = around_figures(world);
    const double side = max(figures.high[0] - figures.low[0], figures.high[1] - figures.low[1]);
    if (scene.world.bounds && scene.world.bounds->box) {
        const auto room = around_room(*scene.world.bounds->box);
        const auto near = figures.grown(side * wall_range);
        return side > 0 && near.overlaps(room) ? overlap_of(room, near) : room;
    }
    auto frame = figures.grown(side * swing_room);
    for (const auto& collider : world.colliders) {
        const auto box = bounds(collider.shape, collider.target);
        const Extent whole{widened(box.low), widened(box.high)}, near = figures.grown(side * collider_range);
        if (!near.overlaps(whole)) continue;
        const auto seen = overlap_of(whole, near);
        frame.include(seen.low);
        frame.include(seen.high);
    }
    return frame;
}

} // namespace

std::array<Point, 2> focus_of(const Scene& scene, const AnyWorld& world) {
    const auto frame = std::visit([&](const auto& any) { return shown_part(any, scene); }, world);
    std::array<Point, 2> corners{};
    for (int i = 0; i < scene.dimension; ++i) corners[0][i] = frame.low[i], corners[1][i] = frame.high[i];
    return corners;
}

} // namespace sinew

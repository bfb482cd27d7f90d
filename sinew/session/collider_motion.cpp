#include "sinew/session/collider_motion.h"

#include "sinew/scene/colliders.h"
#include "sinew/session/driver.h"
#include "sinew/world/colliders.h"

namespace sinew {
namespace {

Point position_of(const ColliderSection& section, const std::optional<Point>& pointer, double time, int up) {
    if (!section.motion || !section.motion->driver) return section.at;
    const auto& driver = *section.motion->driver;
    if (pointer && std::holds_alternative<PointerDriver>(driver)) return *pointer;
    return driven_to(driver, section.at, time, up);
}

} // namespace

void move_colliders(const Scene& scene, const std::optional<Point>& pointer, double time, Arrival arrival,
                    AnyWorld& world) {
    if (scene.colliders.empty()) return;
    const int up = scene.units.up == "-y" ? -1 : 1;
    std::visit(
        [&]<int D, class Real>(World<D, Real>& any) {
            for (Row row = 0; row < any.colliders.size(); ++row) {
                const auto tag = any.colliders[row].tag;
                if (tag >= scene.colliders.size() || !scene.colliders[tag].motion) continue;
                const auto& section = scene.colliders[tag];
                const collide::Pose<D, Real> pose{position_of(section, pointer, time, up).template as<D, Real>(),
                                                  rotation_of<D, Real>(section, time, up)};
                const auto id = any.collider_handles.id_of(row);
                if (arrival == Arrival::at_once)
                    place_collider(any, id, pose);
                else
                    move_collider(any, id, pose);
            }
        },
        world);
}

} // namespace sinew

#include "sinew/session/collider_motion.h"

#include "sinew/scene/colliders.h"
#include "sinew/session/driver.h"
#include "sinew/world/colliders.h"

#include <algorithm>

namespace sinew {
namespace {

Point position_of(const ColliderSection& section, const std::optional<Point>& pointer, double time, int up) {
    if (!section.motion || !section.motion->driver) return section.at;
    const auto& driver = *section.motion->driver;
    if (pointer && std::holds_alternative<PointerDriver>(driver)) return *pointer;
    return driven_to(driver, section.at, time, up);
}

/// Place of a section's collider in the world, and its turn as in the section.
template <class WorldT> Point place_of(const WorldT& world, std::size_t section, const Point& otherwise) {
    for (const auto& collider : world.colliders)
        if (collider.tag == section) {
            Point place;
            for (int k = 0; k < WorldT::dimension; ++k) place[k] = double(collider.target.position[k]);
            return place;
        }
    return otherwise;
}

} // namespace

void ColliderMoves::begin(const AnyWorld& world, const Scene& scene, const ColliderEvent& event) {
    if (!event.to && !event.turn) return;
    for (std::size_t i = 0; i < scene.colliders.size(); ++i) {
        const auto& section = scene.colliders[i];
        if (section.name != event.collider) continue;
        Move move{.section = i, .duration = event.duration};
        move.since = std::visit([](const auto& any) { return any.time; }, world);
        move.from = std::visit([&](const auto& any) { return place_of(any, i, section.at); }, world);
        move.from_turn = section.turn;
        const auto before = std::ranges::find(moves_, i, &Move::section);
        if (before != moves_.end()) {
            const double share =
                before->duration > 0 ? std::clamp((move.since - before->since) / before->duration, 0.0, 1.0) : 1;
            move.from_turn = before->from_turn + (before->to_turn - before->from_turn) * share;
            moves_.erase(before);
        }
        move.to = event.to.value_or(move.from);
        move.to_turn = event.turn.value_or(move.from_turn);
        moves_.push_back(move);
    }
}

void ColliderMoves::carry(AnyWorld& world, const Scene& scene, double step) {
    const int up = scene.units.up == "-y" ? -1 : 1;
    std::visit(
        [&]<int D, class Real>(World<D, Real>& any) {
            for (const auto& move : moves_) {
                const double gone = any.time + step - move.since;
                const double share = move.duration > 0 ? std::clamp(gone / move.duration, 0.0, 1.0) : 1;
                auto section = scene.colliders[move.section];
                section.turn = move.from_turn + (move.to_turn - move.from_turn) * share;
                Point at;
                for (int k = 0; k < D; ++k) at[k] = move.from[k] + (move.to[k] - move.from[k]) * share;
                const collide::Pose<D, Real> pose{at.template as<D, Real>(), rotation_of<D, Real>(section, 0, up)};
                for (Row row = 0; row < any.colliders.size(); ++row)
                    if (any.colliders[row].tag == move.section)
                        move_collider(any, any.collider_handles.id_of(row), pose);
            }
        },
        world);
}

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

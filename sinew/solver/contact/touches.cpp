#include "sinew/solver/phases.h"
#include "sinew/world/asleep.h"

#include <algorithm>

namespace sinew {
namespace {

/// Pairs of the step, in order. Particles asleep touch the same as before.
template <int D, class Real> void list_touches(World<D, Real>& world, const ColliderTouches<D, Real>& touches) {
    auto& touching = world.contacts.touching;
    touching.clear();
    for (Row row = 0; row < world.particles.size(); ++row)
        if (touches.collider[row] != 0)
            touching.push_back(
                {world.particles.slots.slot_of(row), world.collider_slots.slot_of(touches.collider[row] - 1)});
    for (const auto& pair : touches.before)
        if (is_asleep(world.particles, pair.particle) && world.collider_slots.in_use(pair.collider))
            touching.push_back(pair);
    std::sort(touching.begin(), touching.end());
    touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
}

template <int D, class Real>
void report(World<D, Real>& world, EventType type, const ColliderTouch& pair, Real impulse) {
    if (world.events.size() >= events_per_step) return;
    if (!world.particles.slots.in_use(pair.particle) || !world.collider_slots.in_use(pair.collider)) return;
    const Row row = world.particles.slots.row_at(pair.particle);
    world.events.push_back({.type = type,
                            .figure = world.particles.figure[row],
                            .particle = world.particles.slots.id_of(row),
                            .collider = world.collider_slots.id_of(world.collider_slots.row_at(pair.collider)),
                            .impulse = double(impulse)});
}

/// Calls visit(pair) for the pairs of one list that are not in the other; both are in order.
template <class List, class Visit> void each_missing(const List& list, const List& other, Visit&& visit) {
    for (const auto& pair : list)
        if (!std::binary_search(other.begin(), other.end(), pair)) visit(pair);
}

} // namespace

template <int D, class Real> void begin_touches(World<D, Real>& world, Solver<D, Real>& solver) {
    if (world.colliders.empty()) return;
    auto& touches = solver.touches;
    touches.boxes.resize(world.colliders.size());
    for (std::size_t i = 0; i < world.colliders.size(); ++i)
        touches.boxes[i] = collide::bounds_in_step(world.colliders[i]);
    for (auto* pairs : {&world.contacts.touching, &touches.before}) pairs->reserve(world.particles.size());
    touches.collider.assign(world.particles.size(), 0);
    touches.impulse.assign(world.particles.size(), Real(0));
}

template <int D, class Real> void end_touches(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& touching = world.contacts.touching;
    auto& touches = solver.touches;
    if (world.colliders.empty() && touching.empty()) return;
    touches.collider.resize(world.particles.size(), 0);
    touches.impulse.resize(world.particles.size(), Real(0));
    std::swap(touching, touches.before);
    list_touches(world, touches);
    each_missing(touching, touches.before, [&](const auto& pair) {
        report(world, EventType::touched, pair, touches.impulse[world.particles.slots.row_at(pair.particle)]);
    });
    each_missing(touches.before, touching, [&](const auto& pair) { report(world, EventType::parted, pair, Real(0)); });
    for (auto& collider : world.colliders) collider.from = collider.target;
}

#define SINEW_TOUCHES(D, Real)                                                                                         \
    template void begin_touches(World<D, Real>&, Solver<D, Real>&);                                                    \
    template void end_touches(World<D, Real>&, Solver<D, Real>&);
SINEW_INSTANTIATE(SINEW_TOUCHES)

} // namespace sinew

#include "sinew/math/sort.h"
#include "sinew/solver/contact/merge_touches.h"
#include "sinew/solver/contact/sensed_bodies.h"
#include "sinew/solver/phases.h"
#include "sinew/world/asleep.h"

#include <algorithm>
#include <optional>

namespace sinew {
namespace {

/// Slot of a collider, or of a plane that counts on from the colliders.
template <int D, class Real> std::uint32_t slot_of(const World<D, Real>& world, std::uint32_t index) {
    const auto colliders = std::uint32_t(world.colliders.size());
    return index < colliders ? world.collider_handles.index_of(index) : plane_bit | (index - colliders);
}
template <int D, class Real> bool is_there(const World<D, Real>& world, std::uint32_t slot) {
    if (is_plane(slot)) return lists_planes(world) && (slot & ~plane_bit) < world.bounds.size();
    return world.collider_handles.in_use(slot);
}
template <int D, class Real> ColliderId id_of(const World<D, Real>& world, std::uint32_t slot) {
    const auto& handles = world.collider_handles;
    return is_plane(slot) ? ColliderId{.index = slot} : handles.id_of(handles.row_at(slot));
}

template <class Place> TouchPlace place_of(const Place& place) {
    TouchPlace wide{.speed = double(place.speed)};
    for (std::size_t i = 0; i < place.point.component.size(); ++i)
        wide.point[i] = double(place.point[int(i)]), wide.normal[i] = double(place.normal[int(i)]);
    return wide;
}

/// Pairs of a particle and a collider in the step, in order. Particles asleep touch the same as before.
template <int D, class Real> void list_touches(World<D, Real>& world, ColliderTouches<D, Real>& touches) {
    auto& touching = world.contacts.touching;
    touching.clear();
    for (Row row = 0; row < world.particles.size(); ++row)
        for (const auto& touch : touches.of(row))
            if (touch.collider != 0)
                touching.push_back({world.particles.handles.index_of(row),
                                    slot_of(world, touch.collider - 1),
                                    {.impulse = double(touch.impulse)},
                                    place_of(touch.place)});
    for (const auto& pair : touches.before)
        if (is_asleep(world.particles, pair.particle) && is_there(world, pair.collider)) touching.push_back(pair);
    sinew::sort(touching.begin(), touching.end());
    touching.erase(std::unique(touching.begin(), touching.end()), touching.end());
}

/// Pairs of figures in the step, in order. Figures asleep touch the same as before.
template <int D, class Real> void list_figures(World<D, Real>& world, ColliderTouches<D, Real>& touches) {
    const auto sleeps = [&](const FigureTouch& touch) {
        return is_asleep(world.particles, touch.particle[0]) && is_asleep(world.particles, touch.particle[1]);
    };
    auto& figures = world.contacts.figures;
    figures.clear();
    if (!world.contacts.lists_figures) return;
    figures.insert(figures.end(), touches.figures.begin(), touches.figures.end());
    for (const auto& touch : touches.figures_before)
        if (sleeps(touch) && !std::binary_search(touches.figures.begin(), touches.figures.end(), touch))
            figures.push_back(touch);
    merge_touches(figures);
    std::erase_if(figures, [&](const FigureTouch& touch) { // near without a force: goes on, and does not begin
        const auto& before = touches.figures_before;
        return touch.strength.impulse == 0 && !std::binary_search(before.begin(), before.end(), touch);
    });
}

/// Event of a pair; nothing if a side of it is gone.
template <int D, class Real>
std::optional<Event> event_of(const World<D, Real>& world, EventType type, const ColliderTouch& pair) {
    const auto& particles = world.particles.handles;
    if (!particles.in_use(pair.particle) || !is_there(world, pair.collider)) return std::nullopt;
    const Row row = particles.row_at(pair.particle);
    return Event{.type = type,
                 .figure = world.particles.figure[row],
                 .particle = particles.id_of(row),
                 .collider = id_of(world, pair.collider)};
}
template <int D, class Real>
std::optional<Event> event_of(const World<D, Real>& world, EventType type, const FigureTouch& touch) {
    const auto& handles = world.particles.handles;
    if (!handles.in_use(touch.particle[0]) || !handles.in_use(touch.particle[1])) return std::nullopt;
    return Event{.type = type,
                 .figure = touch.first,
                 .particle = handles.id_of(handles.row_at(touch.particle[0])),
                 .other = touch.second,
                 .other_particle = handles.id_of(handles.row_at(touch.particle[1]))};
}

template <int D, class Real, class Touch>
void report(World<D, Real>& world, EventType type, const Touch& touch, double impulse) {
    if (world.events.size() >= events_per_step) return;
    if (auto event = event_of(world, type, touch)) {
        event->impulse = impulse;
        world.events.push_back(*event);
    }
}

/// Compares the touches of a step with those of the step before, both in order.
template <int D, class Real, class Touch>
void compare(World<D, Real>& world, std::vector<Touch>& now, const std::vector<Touch>& before) {
    for (auto& touch : now) {
        const auto known = std::lower_bound(before.begin(), before.end(), touch);
        auto& strength = touch.strength;
        strength.is_new = known == before.end() || *known != touch;
        const auto last = strength.is_new ? TouchStrength{} : known->strength;
        strength.blow = strength.impulse + (last.is_new ? last.impulse : 0);
        strength.blow_before = last.blow;
        if (strength.is_new) report(world, EventType::touched, touch, strength.impulse);
        if (strength.is_hit(world.contacts.hit_impulse)) report(world, EventType::hit, touch, strength.blow);
    }
    for (const auto& touch : before)
        if (!std::binary_search(now.begin(), now.end(), touch)) report(world, EventType::parted, touch, 0);
}

} // namespace

template <int D, class Real> void begin_touches(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& touches = solver.touches;
    touches.figures.clear();
    touches.begin(0, 0);
    const std::size_t planes = lists_planes(world) ? world.bounds.size() : 0;
    if (world.colliders.empty() && planes == 0) return;
    touches.boxes.resize(world.colliders.size());
    for (std::size_t i = 0; i < world.colliders.size(); ++i)
        touches.boxes[i] = collide::bounds_in_step(world.colliders[i]);
    for (auto* pairs : {&world.contacts.touching, &touches.before}) pairs->reserve(world.particles.size());
    touches.begin(world.particles.size(), world.colliders.size() + planes);
}

template <int D, class Real> void end_touches(World<D, Real>& world, Solver<D, Real>& solver) {
    auto& contacts = world.contacts;
    auto& touches = solver.touches;
    if (!world.colliders.empty() || lists_planes(world) || !contacts.touching.empty()) {
        if (world.colliders.empty() && !lists_planes(world)) touches.begin(0, 0);
        std::swap(contacts.touching, touches.before);
        if (std::ranges::any_of(world.colliders, [](const auto& collider) { return collider.is_sensor; }))
            detail::SensedBodies<D, Real>(world, touches, solver.options.contact_filter).note();
        list_touches(world, touches);
        compare(world, contacts.touching, touches.before);
        for (auto& collider : world.colliders) collider.from = collider.target;
    }
    if (contacts.lists_figures || !contacts.figures.empty()) {
        std::swap(contacts.figures, touches.figures_before);
        list_figures(world, touches);
        compare(world, contacts.figures, touches.figures_before);
    }
}

#define SINEW_TOUCHES(D, Real)                                                                                         \
    template void begin_touches(World<D, Real>&, Solver<D, Real>&);                                                    \
    template void end_touches(World<D, Real>&, Solver<D, Real>&);
SINEW_INSTANTIATE(SINEW_TOUCHES)

} // namespace sinew

#include "sinew/solver/contact/colliders.h"

#include <algorithm>

namespace sinew {
namespace {

template <int D, class Real> bool is_finite_pose(const collide::Pose<D, Real>& pose) {
    return is_finite(pose.position) && is_finite(pose.rotation.number);
}

template <int D, class Real> collide::Pose<D, Real> within_limits(collide::Pose<D, Real> pose) {
    pose.position = clamp_components(pose.position, limit::coordinate<Real>);
    return pose;
}

/// Pairs of the step, in order; the columns of the particles are cleared.
template <int D, class Real> void list_touches(World<D, Real>& world, std::vector<ColliderTouch>& touching) {
    auto& contacts = world.contacts;
    touching.clear();
    for (Row row = 0; row < world.particles.size(); ++row)
        if (contacts.touched[row] != 0)
            touching.push_back(
                {world.particles.slots.slot_of(row), world.collider_slots.slot_of(contacts.touched[row] - 1)});
    std::sort(touching.begin(), touching.end());
}

template <int D, class Real> void report(World<D, Real>& world, EventType type, const ColliderTouch& pair) {
    if (world.events.size() >= events_per_step) return;
    if (!world.particles.slots.in_use(pair.particle) || !world.collider_slots.in_use(pair.collider)) return;
    const Row row = world.particles.slots.row_at(pair.particle);
    world.events.push_back({.type = type,
                            .figure = world.particles.figure[row],
                            .particle = world.particles.slots.id_of(row),
                            .collider = world.collider_slots.id_of(world.collider_slots.row_at(pair.collider)),
                            .impulse = type == EventType::touched ? double(world.contacts.pressed[row]) : 0});
}

/// Calls visit(pair) for the pairs of one list that are not in the other; both are in order.
template <class List, class Visit> void each_missing(const List& list, const List& other, Visit&& visit) {
    for (const auto& pair : list)
        if (!std::binary_search(other.begin(), other.end(), pair)) visit(pair);
}

} // namespace

template <int D, class Real>
ColliderId add_collider(World<D, Real>& world, const collide::Collider<D, Real>& collider) {
    world.colliders.push_back(collider);
    auto& added = world.colliders.back();
    added.target = is_finite_pose(added.target) ? within_limits(added.target) : collide::Pose<D, Real>{};
    added.from = added.target;
    added.restitution = clamp(added.restitution, Real(0), Real(1));
    added.friction = clamp(added.friction, Real(0), limit::measure<Real>);
    return world.collider_slots.append();
}

template <int D, class Real> collide::Collider<D, Real>* find_collider(World<D, Real>& world, ColliderId id) {
    const auto row = world.collider_slots.find(id);
    return row ? &world.colliders[*row] : nullptr;
}

template <int D, class Real> bool remove_collider(World<D, Real>& world, ColliderId id) {
    const auto row = world.collider_slots.find(id);
    if (!row) return false;
    std::vector<char> gone(world.colliders.size(), 0);
    gone[*row] = 1;
    world.colliders.erase(world.colliders.begin() + std::ptrdiff_t(*row));
    world.collider_slots.erase(gone);
    return true;
}

template <int D, class Real>
bool move_collider(World<D, Real>& world, ColliderId id, const collide::Pose<D, Real>& target) {
    auto* collider = find_collider(world, id);
    if (!collider || !is_finite_pose(target)) return false;
    collider->target = within_limits(target);
    return true;
}

template <int D, class Real>
bool place_collider(World<D, Real>& world, ColliderId id, const collide::Pose<D, Real>& pose) {
    if (!move_collider(world, id, pose)) return false;
    auto* collider = find_collider(world, id);
    collider->from = collider->target;
    return true;
}

template <int D, class Real>
std::optional<ColliderId> collider_called(const World<D, Real>& world, std::string_view name) {
    for (Row row = 0; row < world.colliders.size(); ++row)
        if (world.colliders[row].name == name) return world.collider_slots.id_of(row);
    return std::nullopt;
}

template <int D, class Real>
bool set_contact(World<D, Real>& world, FigureIndex figure, const FigureContactSpec& spec) {
    if (!has_figure(world, figure)) return false;
    auto& changed = world.figures[figure];
    const bool collides = spec.figures || spec.itself;
    if (changed.collides != collides) world.journal.stale = world.journal.changed = true; // blocks are not for them
    world.journal.changed |= changed.touches_itself != spec.itself || changed.friction != spec.friction;
    changed.collides = collides;
    changed.touches_itself = spec.itself;
    changed.friction = clamp(spec.friction, 0.0, double(limit::measure<Real>));
    changed.filter = spec.filter;
    return true;
}

template <int D, class Real> void begin_contacts(World<D, Real>& world) {
    if (world.colliders.empty()) return;
    auto& contacts = world.contacts;
    contacts.boxes.resize(world.colliders.size());
    for (std::size_t i = 0; i < world.colliders.size(); ++i)
        contacts.boxes[i] = collide::bounds_in_step(world.colliders[i]);
    for (auto* pairs : {&contacts.touching, &contacts.touching_before}) pairs->reserve(world.particles.size());
    contacts.touched.assign(world.particles.size(), 0);
    contacts.pressed.assign(world.particles.size(), Real(0));
}

template <int D, class Real> void end_contacts(World<D, Real>& world) {
    auto& contacts = world.contacts;
    if (world.colliders.empty() && contacts.touching.empty()) return;
    contacts.touched.resize(world.particles.size(), 0);
    contacts.pressed.resize(world.particles.size(), Real(0));
    std::swap(contacts.touching, contacts.touching_before);
    list_touches(world, contacts.touching);
    each_missing(contacts.touching, contacts.touching_before,
                 [&](const auto& pair) { report(world, EventType::touched, pair); });
    each_missing(contacts.touching_before, contacts.touching,
                 [&](const auto& pair) { report(world, EventType::parted, pair); });
    for (auto& collider : world.colliders) collider.from = collider.target;
}

#define SINEW_COLLIDERS(D, Real)                                                                                       \
    template ColliderId add_collider(World<D, Real>&, const collide::Collider<D, Real>&);                              \
    template bool remove_collider(World<D, Real>&, ColliderId);                                                        \
    template bool move_collider(World<D, Real>&, ColliderId, const collide::Pose<D, Real>&);                           \
    template bool place_collider(World<D, Real>&, ColliderId, const collide::Pose<D, Real>&);                          \
    template collide::Collider<D, Real>* find_collider(World<D, Real>&, ColliderId);                                   \
    template std::optional<ColliderId> collider_called(const World<D, Real>&, std::string_view);                       \
    template bool set_contact(World<D, Real>&, FigureIndex, const FigureContactSpec&);                                 \
    template void begin_contacts(World<D, Real>&);                                                                     \
    template void end_contacts(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_COLLIDERS)

} // namespace sinew

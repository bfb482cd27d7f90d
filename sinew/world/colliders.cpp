#include "sinew/world/colliders.h"

namespace sinew {
namespace {

template <int D, class Real> bool is_finite_pose(const collide::Pose<D, Real>& pose) {
    return is_finite(pose.position) && is_finite(pose.rotation.number);
}

template <int D, class Real> collide::Pose<D, Real> within_limits(collide::Pose<D, Real> pose) {
    pose.position = clamp_components(pose.position, limit::coordinate<Real>);
    return pose;
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
    return world.collider_handles.append();
}

template <int D, class Real> collide::Collider<D, Real>* find_collider(World<D, Real>& world, ColliderId id) {
    const auto row = world.collider_handles.find(id);
    return row ? &world.colliders[*row] : nullptr;
}

template <int D, class Real> bool remove_collider(World<D, Real>& world, ColliderId id) {
    const auto row = world.collider_handles.find(id);
    if (!row) return false;
    std::vector<char> gone(world.colliders.size(), 0);
    gone[*row] = 1;
    world.colliders.erase(world.colliders.begin() + std::ptrdiff_t(*row));
    world.collider_handles.erase(gone);
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
        if (world.colliders[row].name == name) return world.collider_handles.id_of(row);
    return std::nullopt;
}

template <int D, class Real>
bool set_contact(World<D, Real>& world, FigureIndex figure, const FigureContactSpec& spec) {
    if (!has_figure(world, figure)) return false;
    auto& changed = world.figures[figure];
    const bool collides = spec.figures || spec.itself;
    if (changed.collides != collides || changed.cloth != spec.cloth)
        world.journal.change_all(); // blocks are not for them
    if (changed.touches_itself != spec.itself || changed.friction != spec.friction) world.journal.change();
    changed.collides = collides;
    changed.touches_itself = spec.itself;
    changed.cloth = spec.cloth;
    changed.friction = clamp(spec.friction, 0.0, double(limit::measure<Real>));
    changed.filter = spec.filter;
    changed.bounce = clamp(spec.bounce, 0.0, 1.0);
    changed.wall_friction = spec.wall_friction;
    if (spec.wall_friction) changed.wall_friction = clamp(*spec.wall_friction, 0.0, double(limit::measure<Real>));
    return true;
}

#define SINEW_COLLIDERS(D, Real)                                                                                       \
    template ColliderId add_collider(World<D, Real>&, const collide::Collider<D, Real>&);                              \
    template bool remove_collider(World<D, Real>&, ColliderId);                                                        \
    template bool move_collider(World<D, Real>&, ColliderId, const collide::Pose<D, Real>&);                           \
    template bool place_collider(World<D, Real>&, ColliderId, const collide::Pose<D, Real>&);                          \
    template collide::Collider<D, Real>* find_collider(World<D, Real>&, ColliderId);                                   \
    template std::optional<ColliderId> collider_called(const World<D, Real>&, std::string_view);                       \
    template bool set_contact(World<D, Real>&, FigureIndex, const FigureContactSpec&);
SINEW_INSTANTIATE(SINEW_COLLIDERS)

} // namespace sinew

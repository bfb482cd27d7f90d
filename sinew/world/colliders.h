#pragma once

#include "sinew/world/world.h"

#include <optional>
#include <string_view>

/// Changes of the colliders of a world, between steps. Ids behave as in edit.h.
namespace sinew {

template <int D, class Real> ColliderId add_collider(World<D, Real>& world, const collide::Collider<D, Real>& collider);
/// Removes a collider; false for an unknown id.
template <int D, class Real> bool remove_collider(World<D, Real>& world, ColliderId id);
/// Pose of a collider at the end of the next step, approached evenly: particles in contact are carried along. False for
/// an unknown id or a pose that is not finite.
template <int D, class Real>
bool move_collider(World<D, Real>& world, ColliderId id, const collide::Pose<D, Real>& target);
/// Moves a collider at once, without carrying anything along.
template <int D, class Real>
bool place_collider(World<D, Real>& world, ColliderId id, const collide::Pose<D, Real>& pose);
/// A collider for reading, and for changing all but its poses; nothing for an unknown id.
template <int D, class Real> collide::Collider<D, Real>* find_collider(World<D, Real>& world, ColliderId id);
/// The first collider of a name.
template <int D, class Real>
std::optional<ColliderId> collider_called(const World<D, Real>& world, std::string_view name);

/// Contact of a figure with colliders and with other figures.
struct FigureContactSpec {
    bool figures = false;                               ///< its particles and links touch other figures with the same
    bool itself = false;                                ///< they touch each other, except for neighbours on a link
    ClothContactKind cloth = ClothContactKind::spheres; ///< of its faces with themselves and other cloth (3D)
    double friction = 0.5;                              ///< against other figures; the smaller one counts
    collide::Filter filter{};
    double bounce = 0;                     ///< restitution; of two that touch the larger one counts
    std::optional<double> wall_friction{}; ///< against walls, in place of theirs
};
/// Changes the contact of a figure; false for an unknown figure.
template <int D, class Real> bool set_contact(World<D, Real>& world, FigureIndex figure, const FigureContactSpec& spec);

} // namespace sinew

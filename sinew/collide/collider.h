#pragma once

#include "sinew/collide/filter.h"
#include "sinew/collide/shape.h"

#include <limits>
#include <string>
#include <type_traits>

namespace sinew::collide {

/// A rigid shape that particles touch: at rest, or moved from outside.
template <int D, class Real> struct Collider {
    Shape<D, Real> shape{};
    Pose<D, Real> from{};   ///< at the start of the step
    Pose<D, Real> target{}; ///< at the end of the step; interpolated over the substeps
    Real restitution = 0;   ///< share of the approach speed given back, 0..1
    Real friction = 0;      ///< Coulomb's coefficient
    Filter filter{};
    Vec<D, Real>
        one_way{}; ///< solid only for contacts with a normal along this direction, in the shape's frame; or zero
    bool is_sensor = false; ///< touched without a push
    Vec<D, Real>
        surface_velocity{}; ///< of a belt: the surface runs along itself, in the shape's frame, length per time
    std::string name{};
    std::uint32_t tag = ~std::uint32_t(0); ///< chosen by the owner; in a scene: index of its section

    /// False for one that touches nothing, and is not drawn.
    bool is_enabled() const { return filter != Filter{0, 0}; }
    bool is_at_rest() const { return from == target; }
    /// True if the surface may do work on a body that touches it.
    bool is_driven() const { return !is_at_rest() || surface_velocity != Vec<D, Real>{}; }
    /// Velocity of the surface along itself where it has a normal, both in the world.
    template <class T> Vec<D, T> belt_velocity(const Pose<D, T>& pose, const Vec<D, T>& normal) const {
        if (surface_velocity == Vec<D, Real>{}) return {};
        const auto velocity = pose.turn(cast<T>(surface_velocity));
        return velocity - normal * dot(normal, velocity);
    }
    /// Pose after a fraction of the step.
    template <class T = Real> Pose<D, T> pose_at(std::type_identity_t<T> share) const {
        const auto end = target.template as<T>();
        return is_at_rest() ? end : Pose<D, T>::between(from.template as<T>(), end, share);
    }
    bool is_solid_along(const Vec<D, Real>& local_normal) const {
        constexpr Real half = Real(0.5);
        return one_way == Vec<D, Real>{} || dot(one_way, local_normal) > half * norm(one_way);
    }
};

/// Box around a shape, with the layer behind its parts from which spheres are pushed out.
template <int D, class Real>
BoundingBox<D, Real> bounds_with_layer(const Shape<D, Real>& shape, const Pose<D, Real>& pose) {
    const auto box = bounds(shape, pose);
    return std::visit(
        [&]<class Held>(const Held&) {
            return IsSurface<Held> ? box.grown(share_behind<Real> * norm(box.high - box.low)) : box;
        },
        shape);
}

/// Box around a collider during a whole step. A turning shape stays within the sphere about its origin.
template <int D, class Real> BoundingBox<D, Real> bounds_in_step(const Collider<D, Real>& collider) {
    auto box = bounds_with_layer(collider.shape, collider.from);
    if (collider.is_at_rest()) return box;
    const auto end = bounds_with_layer(collider.shape, collider.target);
    box.include(end.low);
    box.include(end.high);
    if (collider.from.rotation == collider.target.rotation || !(box.high[0] < box.huge)) return box;
    Real radius = 0;
    for (const auto* pose : {&collider.from, &collider.target}) {
        const auto around = bounds(collider.shape, *pose);
        const auto far = Vec<D, Real>::map([&](int i) {
            return max(absolute(around.low[i] - pose->position[i]), absolute(around.high[i] - pose->position[i]));
        });
        radius = max(radius, norm(far));
    }
    BoundingBox<D, Real> turned;
    turned.include(collider.from.position);
    turned.include(collider.target.position);
    turned = turned.grown(radius);
    turned.include(box.low);
    turned.include(box.high);
    return turned;
}

} // namespace sinew::collide

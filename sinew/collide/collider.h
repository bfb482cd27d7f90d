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
    std::string name{};
    std::uint32_t tag = ~std::uint32_t(0); ///< chosen by the owner; in a scene: index of its section

    bool is_at_rest() const { return from == target; }
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

/// A contact of a sphere with a collider, during part of a step.
template <int D, class Real> struct ColliderContact {
    SurfacePoint<D, Real> surface{};     ///< at the end
    Vec<D, Real> surface_displacement{}; ///< displacement of the surface
    Real begun_depth = 0;                ///< depth of the sphere at the start, negative in front
    bool begins_in_front = true;         ///< of a one-way collider: the sphere approaches, and began in front
};

/// True for a sphere that approaches, and began in front of a surface at a distance. `moved`, `far`: lengths of its
/// displacement and of its place, for the slop.
template <class Real> bool comes_from_outside(Real distance, Real displacement, Real radius, Real moved, Real far) {
    constexpr Real little = Real(64) * std::numeric_limits<Real>::epsilon(), some = Real(0.02);
    return displacement < Real(0) && distance >= radius - some * (radius + moved) - little * far;
}

/// Contacts of spheres with one collider that moves between two poses, computed in the precision T.
template <int D, class Real, class T = Real> class MovingCollider {
  public:
    using Vector = Vec<D, T>;

    MovingCollider(const Collider<D, Real>& collider, T from_share, T to_share)
        : collider_(collider), one_way_(cast<T>(collider.one_way)), before_(collider.template pose_at<T>(from_share)),
          after_(collider.template pose_at<T>(to_share)) {}

    /// Calls visit(contact) with the contacts of a sphere that moves from one place to another, and with surfaces
    /// within a margin of it. A motion long against the radius is swept: the contact is the first one on the way, and
    /// no wall is too thin. Seen from the collider.
    template <class Visit>
    void contacts(const Vector& from, const Vector& to, T radius, T margin, Visit&& visit) const {
        const auto begun = before_.to_local(from), ended = after_.to_local(to);
        BoundingBox<D, Real> near;
        near.include(cast<Real>(begun));
        near.include(cast<Real>(ended));
        std::visit(
            [&](const auto& shape) {
                visit_parts(shape, near.grown(Real(radius + margin)), [&](const auto& part) {
                    const auto& exact = part.template as<T>();
                    const auto surface = contact_of(exact, begun, ended, radius + margin);
                    if (!surface) return;
                    const T distance = exact.nearest(begun).distance;
                    visit(ColliderContact<D, T>{to_world(after_, *surface), displacement_of(surface->point),
                                                radius - distance,
                                                begins_in_front(*surface, distance, begun, ended - begun, radius)});
                });
            },
            collider_.shape);
    }
    /// Same for what a one-way collider holds only if it comes from the front.
    template <class Visit> void contacts(const Vector& from, const Vector& to, T radius, Visit&& visit) const {
        contacts(from, to, radius, T(0), [&](const auto& contact) {
            if (contact.begins_in_front) visit(contact);
        });
    }

  private:
    const Collider<D, Real>& collider_;
    Vector one_way_;
    Pose<D, T> before_, after_;

    Vector displacement_of(const Vector& local) const {
        return collider_.is_at_rest() ? Vector{} : after_.to_world(local) - before_.to_world(local);
    }

    template <class Part>
    std::optional<SurfacePoint<D, T>> contact_of(const Part& part, const Vector& begun, const Vector& ended,
                                                 T radius) const {
        constexpr T half = T(0.5);
        const auto displacement = ended - begun;
        if (one_sided<Part>() && part.nearest(begun).distance < -depth_of(part, begun, displacement, radius))
            return std::nullopt;
        std::optional<SurfacePoint<D, T>> surface;
        if (dot(displacement, displacement) > square(half * radius))
            if (const auto impact = sweep(part, begun, displacement, radius)) surface = impact->surface;
        if (!surface) surface = part.nearest(ended);
        const bool touches = dot(surface->normal, ended - surface->point) < radius;
        if (!touches || !owns(part, *surface) || !collider_.is_solid_along(cast<Real>(surface->normal)))
            return std::nullopt;
        return surface;
    }

    /// Depth behind a one-sided part from which a sphere is still pushed out: contacts give a little.
    template <class Part>
    static T depth_of(const Part& part, const Vector& begun, const Vector& displacement, T radius) {
        constexpr T half = T(0.5), little = T(64) * std::numeric_limits<T>::epsilon(), some = share_behind<T>;
        T size = 0;
        if constexpr (one_sided<Part>()) size = norm(part.b - part.a);
        return half * radius + little * norm(begun) + some * (norm(displacement) + size);
    }
    bool begins_in_front(const SurfacePoint<D, T>& surface, T distance, const Vector& begun, const Vector& displacement,
                         T radius) const {
        return one_way_ == Vector{} ||
               comes_from_outside(distance, dot(surface.normal, displacement), radius, norm(displacement), norm(begun));
    }
    template <class Part> static constexpr bool one_sided() {
        return requires(const Part& part, SurfacePoint<D, T> surface) {
            part.owns(surface);
        };
    }
};

} // namespace sinew::collide

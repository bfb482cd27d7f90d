#pragma once

#include "sinew/collide/collider.h"

#include <optional>
#include <span>

namespace sinew::collide {

/// Solids beside each other: a sphere that slides over flush boxes meets neither the corners nor the faces between
/// them. A contact at p with the normal n, of a sphere about c, belongs to another solid
///
///     that reaches a corner p and is nearer to c than p, or as near and earlier in the list, or
///     that has p inside, or on a face that looks against n     (p is not on the surface of the union).
///
/// Surfaces that cross leave p on the union's surface: both hold spheres between.
template <int D, class Real, class T> class Cover {
  public:
    /// Sphere of a contact. `motion`: length of its displacement, by which the sphere may be behind its support.
    struct Ball {
        T radius = 0, motion = 0;
    };

    /// `boxes`: around the colliders during the step. `share`: of the step, at the contact.
    Cover(std::span<const Collider<D, Real>> colliders, std::span<const BoundingBox<D, Real>> boxes, T share,
          const Filter& filter)
        : colliders_(colliders), boxes_(boxes), share_(share), filter_(filter) {}

    /// The contact itself, in the frame of its part, unless something covers it: then, for a sphere with its centre
    /// inside the part, the nearest face that nothing covers; nothing for one outside. A centre on a corner or an edge,
    /// to rounding, is inside: the direction from there would be rounding error.
    template <class Part>
    std::optional<SurfacePoint<D, T>> exposed(const Collider<D, Real>& owner, const Part& part, const Pose<D, T>& pose,
                                              const SurfacePoint<D, T>& contact, const Ball& ball) const {
        if (colliders_.size() < 2) return contact;
        const auto seen = to_world(pose, contact);
        const T little = little_of(seen, ball);
        const bool is_within = contact.distance <= little;
        const bool is_face = contact.distance < T(0) || is_on_face<D, Real>(owner.shape, contact.feature);
        constexpr bool has_faces = requires {
            part.each_face(contact.point, [](const auto&) {});
        };
        const bool is_sharp = has_faces && is_within && !is_face;
        if (!is_sharp && !covers(owner, part, pose, seen, is_face, ball, little)) return contact;
        std::optional<SurfacePoint<D, T>> nearest;
        if (!is_within) return nearest;
        if constexpr (has_faces)
            part.each_face(contact.point + contact.normal * contact.distance, [&](const SurfacePoint<D, T>& face) {
                if ((!nearest || face.distance > nearest->distance) &&
                    !covers(owner, part, pose, to_world(pose, face), true, ball, little))
                    nearest = face;
            });
        return nearest || contact.distance >= T(0) ? nearest : contact;
    }

  private:
    std::span<const Collider<D, Real>> colliders_;
    std::span<const BoundingBox<D, Real>> boxes_;
    T share_;
    Filter filter_;

    static T little_of(const SurfacePoint<D, T>& contact, const Ball& ball) {
        constexpr T part = T(1e-3);
        return part * ball.radius + T(64) * std::numeric_limits<Real>::epsilon() *
                                        (norm(contact.point) + absolute(contact.distance) + ball.motion);
    }
    bool is_solid_beside(const Collider<D, Real>& other, const Collider<D, Real>& owner) const {
        return &other != &owner && !other.is_sensor && touch(other.filter, filter_) &&
               (other.one_way == Vec<D, Real>{} || owner.one_way != Vec<D, Real>{});
    }
    /// Calls visit(part, its pose, index of its collider) with the parts of other solids near a point, until one
    /// returns true; returns true then.
    template <class Visit>
    bool any_beside(const Collider<D, Real>& owner, const Vec<D, T>& point, T little, Visit&& visit) const {
        BoundingBox<D, Real> near;
        near.include(cast<Real>(point));
        near = near.grown(Real(T(4) * little));
        bool found = false;
        for (std::size_t i = 0; i < colliders_.size() && !found; ++i) {
            const auto& other = colliders_[i];
            if (!boxes_[i].overlaps(near) || !is_solid_beside(other, owner)) continue;
            const auto pose = other.template pose_at<T>(share_);
            BoundingBox<D, Real> there;
            there.include(cast<Real>(pose.to_local(point)));
            std::visit(
                [&]<class Held>(const Held& shape) {
                    visit_parts(shape, there.grown(Real(T(4) * little)), [&](const auto& part) {
                        const auto& exact = part.template as<T>();
                        found = found || visit(exact, pose, other);
                    });
                },
                other.shape);
        }
        return found;
    }
    template <class Part>
    bool covers(const Collider<D, Real>& owner, const Part& part, const Pose<D, T>& pose,
                const SurfacePoint<D, T>& contact, bool is_face, const Ball& ball, T little) const {
        return any_beside(
            owner, contact.point, little, [&](const auto& other, const auto& there, const auto& collider) {
                const auto point = there.to_local(contact.point), normal = there.turn_back(contact.normal);
                if (other.nearest(point).distance > little) return false;
                const auto center = point + normal * contact.distance;
                if (!is_face && is_nearer(other, center, contact.distance, &collider < &owner)) return true;
                return seals(other, point, normal, little) &&
                       !ends_beside(owner, part, pose, other, there, contact, ball, little);
            });
    }
    template <class Part>
    static bool is_nearer(const Part& other, const Vec<D, T>& center, T distance, bool is_before) {
        const T rounding = T(8) * std::numeric_limits<Real>::epsilon() * (norm(center) + absolute(distance));
        return other.nearest(center).distance < distance + (is_before ? rounding : -rounding);
    }
    /// True for a point inside a solid, or on a face that looks against a normal there.
    template <class Part>
    static bool seals(const Part& other, const Vec<D, T>& point, const Vec<D, T>& normal, T little) {
        if constexpr (requires { other.owns(other.nearest(point)); }) {
            return false;
        } else {
            constexpr T against = T(-0.999);
            const auto surface = other.nearest(point);
            bool found =
                surface.distance < -little || (surface.distance <= little && dot(surface.normal, normal) < against);
            if constexpr (requires { other.each_face(point, [](const auto&) {}); })
                if (!found && surface.distance <= little)
                    other.each_face(point, [&](const SurfacePoint<D, T>& face) {
                        found = found || (face.distance >= -little && dot(face.normal, normal) < against);
                    });
            return found;
        }
    }
    /// True if the other solid ends within the motion of the sphere, and the owner's surface goes on there: a wall that
    /// stands beside a floor, met by a sphere sunk into the floor.
    template <class Part, class Other>
    bool ends_beside(const Collider<D, Real>& owner, const Part& part, const Pose<D, T>& pose, const Other& other,
                     const Pose<D, T>& there, const SurfacePoint<D, T>& contact, const Ball& ball, T little) const {
        bool found = false;
        if constexpr (requires { other.each_face(contact.point, [](const auto&) {}), part.nearest(contact.point); })
            other.each_face(there.to_local(contact.point), [&](const SurfacePoint<D, T>& face) {
                const auto normal = there.turn(face.normal);
                if (found || !(face.distance > -(ball.motion + T(2) * little)) ||
                    absolute(dot(normal, contact.normal)) > T(0.5))
                    return;
                const auto beyond = contact.point + normal * (T(2) * little - face.distance);
                if (part.nearest(pose.to_local(beyond)).distance > little) return;
                found = !any_beside(owner, beyond, little, [&](const auto& third, const auto& at, const auto&) {
                    return seals(third, at.to_local(beyond), at.turn_back(contact.normal), little);
                });
            });
        return found;
    }
};

} // namespace sinew::collide

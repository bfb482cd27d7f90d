#pragma once

#include "sinew/collide/collider.h"

#include <optional>
#include <span>

namespace sinew::collide {

/// Solids beside each other: a sphere that slides over flush boxes meets neither the corners nor the faces between
/// them. A contact at p with the normal n, of a sphere about c, belongs to another solid
///
///     that reaches a corner p and is nearer to c than p is     (p is not the nearest point of the union around), or
///     that has p + little n inside                             (p is not on the surface of the union).
template <int D, class Real, class T> class Cover {
  public:
    /// `boxes`: around the colliders during the step. `share`: of the step, at the contact.
    Cover(std::span<const Collider<D, Real>> colliders, std::span<const BoundingBox<D, Real>> boxes, T share,
          const Filter& filter)
        : colliders_(colliders), boxes_(boxes), share_(share), filter_(filter) {}

    /// True for a contact of the collider `owner` that another one covers.
    bool covers(const Collider<D, Real>& owner, const SurfacePoint<D, T>& contact, T radius) const {
        if (colliders_.size() < 2) return false;
        const bool is_face = contact.distance < T(0) || is_on_face<D, Real>(owner.shape, contact.feature);
        constexpr T part = T(1e-3);
        const T far = norm(contact.point) + absolute(contact.distance);
        const T little = part * radius + T(64) * std::numeric_limits<Real>::epsilon() * far;
        BoundingBox<D, Real> near;
        near.include(cast<Real>(contact.point));
        near = near.grown(Real(T(2) * little));
        for (std::size_t i = 0; i < colliders_.size(); ++i)
            if (&colliders_[i] != &owner && boxes_[i].overlaps(near) && is_solid_beside(colliders_[i], owner) &&
                covers(colliders_[i], contact, is_face, little))
                return true;
        return false;
    }

    /// The contact itself, in the frame of its part, unless something covers it: then, for a sphere with its centre
    /// inside the part, the nearest face that nothing covers; nothing for one outside.
    template <class Part>
    std::optional<SurfacePoint<D, T>> exposed(const Collider<D, Real>& owner, const Part& part, const Pose<D, T>& pose,
                                              const SurfacePoint<D, T>& contact, T radius) const {
        if (!covers(owner, to_world(pose, contact), radius)) return contact;
        std::optional<SurfacePoint<D, T>> nearest;
        if (!(contact.distance < T(0))) return nearest;
        if constexpr (requires { part.each_face(contact.point, [](const auto&) {}); })
            part.each_face(contact.point + contact.normal * contact.distance, [&](const SurfacePoint<D, T>& face) {
                if ((!nearest || face.distance > nearest->distance) && !covers(owner, to_world(pose, face), radius))
                    nearest = face;
            });
        return nearest ? nearest : contact;
    }

  private:
    std::span<const Collider<D, Real>> colliders_;
    std::span<const BoundingBox<D, Real>> boxes_;
    T share_;
    Filter filter_;

    bool is_solid_beside(const Collider<D, Real>& other, const Collider<D, Real>& owner) const {
        return !other.is_sensor && touch(other.filter, filter_) &&
               (other.one_way == Vec<D, Real>{} || owner.one_way != Vec<D, Real>{});
    }
    bool covers(const Collider<D, Real>& other, const SurfacePoint<D, T>& contact, bool is_face, T little) const {
        const auto pose = other.template pose_at<T>(share_);
        const auto point = pose.to_local(contact.point), normal = pose.turn_back(contact.normal);
        const auto center = point + normal * contact.distance, beyond = point + normal * (T(2) * little);
        const T rounding = T(8) * std::numeric_limits<Real>::epsilon() * (norm(center) + absolute(contact.distance));
        BoundingBox<D, Real> near;
        near.include(cast<Real>(point));
        bool found = false;
        std::visit(
            [&]<class Held>(const Held& shape) {
                visit_parts(shape, near.grown(Real(T(2) * little)), [&](const auto& part) {
                    const auto& exact = part.template as<T>();
                    if (found || exact.nearest(point).distance > little) return;
                    found = (!is_face && exact.nearest(center).distance < contact.distance - rounding) ||
                            (!IsSurface<Held> && exact.nearest(beyond).distance < T(0));
                });
            },
            other.shape);
        return found;
    }
};

} // namespace sinew::collide

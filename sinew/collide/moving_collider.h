#pragma once

#include "sinew/collide/cover.h"

#include <array>

namespace sinew::collide {

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

    /// `duration`: of the part of the step. `cover`: solids beside the collider.
    MovingCollider(const Collider<D, Real>& collider, T from_share, T to_share, T duration,
                   const Cover<D, Real, T>& cover)
        : collider_(collider), cover_(cover), duration_(duration), one_way_(cast<T>(collider.one_way)),
          before_(collider.template pose_at<T>(from_share)), after_(collider.template pose_at<T>(to_share)) {}

    /// Calls visit(contact) with the contacts of a sphere that moves from one place to another, and with surfaces
    /// within a margin of it. A motion long against the radius is swept: the contact is the first one on the way, and
    /// no wall is too thin. Seen from the collider.
    template <class Visit>
    void contacts(const Vector& from, const Vector& to, T radius, T margin, Visit&& visit) const {
        const auto begun = before_.to_local(from), ended = after_.to_local(to);
        BoundingBox<D, Real> near;
        near.include(cast<Real>(begun));
        near.include(cast<Real>(ended));
        near = near.grown(Real(radius + margin));
        const Spheres spheres{begun, ended, radius, margin};
        std::visit(
            [&]<class Held>(const Held& shape) {
                if constexpr (IsSurface<Held> && D == 3)
                    visit_exposed_parts(shape, near, spheres, visit);
                else
                    visit_parts(shape, near, [&](const auto& part) {
                        const auto& exact = part.template as<T>();
                        if (const auto surface = contact_of(exact, spheres))
                            visit(contact_at(*surface, exact, spheres));
                    });
            },
            collider_.shape);
    }
    /// Same; a one-way collider holds only what comes from the front.
    template <class Visit> void contacts(const Vector& from, const Vector& to, T radius, Visit&& visit) const {
        contacts(from, to, radius, T(0), [&](const auto& contact) {
            if (contact.begins_in_front) visit(contact);
        });
    }

  private:
    /// A sphere that moves, in the shape's frame.
    struct Spheres {
        Vector begun, ended;
        T radius, margin;
    };
    const Collider<D, Real>& collider_;
    const Cover<D, Real, T>& cover_;
    T duration_;
    Vector one_way_;
    Pose<D, T> before_, after_;

    template <class Part>
    ColliderContact<D, T> contact_at(const SurfacePoint<D, T>& surface, const Part& part,
                                     const Spheres& spheres) const {
        const T distance = part.nearest(spheres.begun).distance;
        const auto seen = to_world(after_, surface);
        return {seen, displacement_of(surface.point) + collider_.belt_velocity(after_, seen.normal) * duration_,
                spheres.radius - distance,
                begins_in_front(surface, distance, spheres.begun, spheres.ended - spheres.begun, spheres.radius)};
    }

    /// Contacts with the triangles of a surface. An edge or a corner counts once, and only where no triangle that
    /// reaches it is nearer: a flat surface has no edges. Beyond `most` contacts all count.
    template <class Surface, class Visit>
    void visit_exposed_parts(const Surface& shape, const BoundingBox<D, Real>& near, const Spheres& spheres,
                             Visit& visit) const {
        constexpr std::size_t most = 32;
        using Part = decltype(std::declval<const typename Surface::Part&>().template as<T>());
        struct Found {
            Part part;
            SurfacePoint<D, T> surface;
        };
        std::array<Found, most> found;
        std::size_t count = 0;
        visit_parts(shape, near, [&](const auto& part) {
            const auto exact = part.template as<T>();
            const auto surface = contact_of(exact, spheres);
            if (!surface) return;
            if (count == most) return void(visit(contact_at(*surface, exact, spheres)));
            found[count++] = {exact, *surface};
        });
        const auto covers = [&](const Found& other, const Found& one, bool is_before) {
            const auto& [point, normal, distance, feature] = one.surface;
            const auto center = point + normal * distance;
            const T far = norm(center) + absolute(distance),
                    rounding = T(8) * std::numeric_limits<Real>::epsilon() * far;
            const T there = other.part.nearest(center).distance;
            return absolute(other.part.nearest(point).distance) <= T(8) * rounding &&
                   there < distance + (is_before ? rounding : -rounding);
        };
        for (std::size_t i = 0; i < count; ++i) {
            bool is_covered = false;
            for (std::size_t k = 0; k < count && !is_covered && !found[i].part.is_inside(found[i].surface); ++k)
                is_covered = k != i && covers(found[k], found[i], k < i);
            if (!is_covered) visit(contact_at(found[i].surface, found[i].part, spheres));
        }
    }

    Vector displacement_of(const Vector& local) const {
        return collider_.is_at_rest() ? Vector{} : after_.to_world(local) - before_.to_world(local);
    }

    template <class Part> std::optional<SurfacePoint<D, T>> contact_of(const Part& part, const Spheres& spheres) const {
        constexpr T half = T(0.5);
        const auto& [begun, ended, radius, margin] = spheres;
        const T within = radius + margin;
        const auto displacement = ended - begun;
        if (one_sided<Part>() && part.nearest(begun).distance < -depth_of(part, begun, displacement, within))
            return std::nullopt;
        std::optional<SurfacePoint<D, T>> surface;
        if (dot(displacement, displacement) > square(half * within))
            if (const auto impact = sweep(part, begun, displacement, within)) surface = impact->surface;
        if (!surface) surface = part.nearest(ended);
        const auto touches = [&] { return surface && dot(surface->normal, ended - surface->point) < within; };
        if (!touches() || !owns(part, *surface) || !collider_.is_solid_along(cast<Real>(surface->normal)))
            return std::nullopt;
        surface = cover_.exposed(collider_, part, after_, *surface, radius);
        return touches() ? surface : std::nullopt;
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

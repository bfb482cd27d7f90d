#pragma once

#include "sinew/collide/cover.h"
#include "sinew/collide/part_owner.h"

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
                if constexpr (IsSurface<Held>)
                    visit_surface(shape, near, spheres, visit);
                else
                    visit_parts(shape, near, [&](const auto& part) {
                        const auto& exact = part.template as<T>();
                        if (const auto surface = contact_of(exact, spheres))
                            visit(contact_at(*surface, exact, spheres));
                    });
            },
            collider_.shape);
    }
    /// Same; a one-way collider holds only particles that come from the front.
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

    /// Contacts with the parts of a surface (part_owner.h). Of a swept sphere, parts touched at the first impact
    /// count there, others at their own impact, or at the end. Beyond `most` parts all count.
    template <class Surface, class Visit>
    void visit_surface(const Surface& shape, const BoundingBox<D, Real>& near, const Spheres& spheres,
                       Visit& visit) const {
        constexpr std::size_t most = 32;
        using Part = decltype(std::declval<const typename Surface::Part&>().template as<T>());
        std::array<FoundPart<Part, Vector>, most> found;
        std::size_t count = 0;
        std::optional<T> first;
        T rounding = rounding_of(spheres);
        const auto& [begun, ended, radius, margin] = spheres;
        const T within = radius + margin;
        const auto take = [&](const auto& surface, const auto& part) {
            if (const auto left = held(part, surface, spheres)) visit(contact_at(*left, part, spheres));
        };
        visit_parts(shape, near, [&](const auto& part) {
            const auto exact = part.template as<T>();
            if (is_passed(exact, spheres)) return;
            const auto impact = impact_on(exact, spheres);
            const bool ends_near = impact || is_near(exact, ended, spheres, rounding);
            if (!ends_near && !is_near(exact, begun, spheres, rounding)) return;
            const auto center = impact ? begun + (ended - begun) * impact->time : ends_near ? ended : begun;
            if (count == most) return take(exact.nearest(center), exact);
            if (impact && !(first && *first <= impact->time)) first = impact->time;
            for (const auto& corner : exact.corners()) rounding = max(rounding, grain * (norm(begun) + norm(corner)));
            found[count++] = {exact, center};
        });
        if (first)
            for (std::size_t i = 0; i < count; ++i) {
                const auto center = begun + (ended - begun) * *first;
                if (found[i].part.nearest(center).distance <= within + reach * rounding) found[i].center = center;
            }
        const PartOwner<D, T, Part> owner({found.data(), count}, rounding);
        for (std::size_t i = 0; i < count; ++i)
            if (const auto surface = owner.contact(i)) take(*surface, found[i].part);
    }
    /// True if a sphere touches a part, or is behind one beyond an edge: in a valley a part has no face there.
    template <class Part>
    static bool is_near(const Part& part, const Vector& center, const Spheres& spheres, T rounding) {
        const auto surface = part.nearest(center);
        const T within = spheres.radius + spheres.margin;
        if (surface.distance < within + rounding) return true;
        return !part.is_inside(surface) && dot(part.normal(), center - part.a) <= rounding &&
               surface.distance < depth_of(part, spheres.begun, spheres.ended - spheres.begun, within);
    }
    static constexpr T grain = T(4) * std::numeric_limits<Real>::epsilon();
    static constexpr T reach = 8; ///< rounding errors of a sweep
    static T rounding_of(const Spheres& spheres) {
        return grain * (norm(spheres.begun) + norm(spheres.ended - spheres.begun) + spheres.radius + spheres.margin);
    }

    Vector displacement_of(const Vector& local) const {
        return collider_.is_at_rest() ? Vector{} : after_.to_world(local) - before_.to_world(local);
    }

    template <class Part> std::optional<SurfacePoint<D, T>> contact_of(const Part& part, const Spheres& spheres) const {
        const auto impact = impact_on(part, spheres);
        return held(part, impact ? impact->surface : part.nearest(spheres.ended), spheres);
    }
    /// First contact of a sphere whose motion is long against its radius.
    template <class Part> std::optional<Impact<D, T>> impact_on(const Part& part, const Spheres& spheres) const {
        constexpr T half = T(0.5);
        const auto displacement = spheres.ended - spheres.begun;
        const T within = spheres.radius + spheres.margin;
        if (!(dot(displacement, displacement) > square(half * within))) return std::nullopt;
        return sweep(part, spheres.begun, displacement, within);
    }
    /// The contact that acts at a surface, unless another solid covers it.
    template <class Part>
    std::optional<SurfacePoint<D, T>> held(const Part& part, const SurfacePoint<D, T>& surface,
                                           const Spheres& spheres) const {
        const T within = spheres.radius + spheres.margin;
        const auto touches = [&](const SurfacePoint<D, T>& contact, T slop = 0) {
            return dot(contact.normal, spheres.ended - contact.point) < within + slop;
        };
        // A centre on an edge, to rounding, may touch the other face.
        if (!touches(surface, reach * (rounding_of(spheres) + grain * norm(after_.position))) ||
            !collider_.is_solid_along(cast<Real>(surface.normal)))
            return std::nullopt;
        const auto left = cover_.exposed(collider_, part, after_, surface,
                                         {spheres.radius, norm(spheres.ended - spheres.begun) + spheres.margin});
        return left && touches(*left) ? left : std::nullopt;
    }
    template <class Part> bool is_passed(const Part& part, const Spheres& spheres) const {
        const auto& [begun, ended, radius, margin] = spheres;
        return part.nearest(begun).distance < -depth_of(part, begun, ended - begun, radius + margin);
    }
    /// Depth behind a part of a surface from which a sphere is still pushed out: contacts give a little.
    template <class Part>
    static T depth_of(const Part& part, const Vector& begun, const Vector& displacement, T radius) {
        constexpr T half = T(0.5), little = T(64) * std::numeric_limits<T>::epsilon(), some = share_behind<T>;
        return half * radius + little * norm(begun) + some * (norm(displacement) + norm(part.b - part.a));
    }
    bool begins_in_front(const SurfacePoint<D, T>& surface, T distance, const Vector& begun, const Vector& displacement,
                         T radius) const {
        return one_way_ == Vector{} ||
               comes_from_outside(distance, dot(surface.normal, displacement), radius, norm(displacement), norm(begun));
    }
};

} // namespace sinew::collide

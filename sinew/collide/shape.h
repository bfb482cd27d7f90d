#pragma once

#include "sinew/collide/box.h"
#include "sinew/collide/capsule.h"
#include "sinew/collide/chain.h"
#include "sinew/collide/convex.h"
#include "sinew/collide/half_space.h"
#include "sinew/collide/height_field.h"
#include "sinew/collide/mesh.h"
#include "sinew/collide/polygon.h"
#include "sinew/collide/sphere.h"

#include <variant>

/// Rigid shapes in a pose. A shape is one convex part, or a surface of many parts, each solid behind.
namespace sinew::collide {

namespace detail {
template <int D, class Real> struct ShapeList;
template <class Real> struct ShapeList<2, Real> {
    using type = std::variant<HalfSpace<2, Real>, Sphere<2, Real>, Capsule<2, Real>, Box<2, Real>, Polygon<2, Real>,
                              Chain<2, Real>>;
};
template <class Real> struct ShapeList<3, Real> {
    using type = std::variant<HalfSpace<3, Real>, Sphere<3, Real>, Capsule<3, Real>, Box<3, Real>, Mesh<3, Real>,
                              HeightField<3, Real>>;
};
} // namespace detail

/// THE list of shapes.
template <int D, class Real> using Shape = typename detail::ShapeList<D, Real>::type;

template <class T>
concept IsSurface = requires {
    typename T::Part;
};

template <int D, class Real> BoundingBox<D, Real> bounds(const Shape<D, Real>& shape, const Pose<D, Real>& pose) {
    return std::visit([&](const auto& held) { return held.bounds(pose); }, shape);
}

/// Box in a shape's frame around a box in the world.
template <int D, class Real> BoundingBox<D, Real> to_local(const Pose<D, Real>& pose, const BoundingBox<D, Real>& box) {
    const auto center = (box.low + box.high) * Real(0.5);
    return Box<D, Real>{box.high - box.low}.bounds({pose.to_local(center), pose.rotation.inverse()});
}

/// Calls visit(part) for the convex parts of a shape that touch a box, both in the shape's frame.
template <class ShapeT, int D, class Real, class Visit>
void visit_parts(const ShapeT& shape, const BoundingBox<D, Real>& near, Visit&& visit) {
    if constexpr (IsSurface<ShapeT>)
        shape.parts_near(near, visit);
    else
        visit(shape);
}

/// False for a contact that belongs to a neighbouring part, or lies behind a surface.
template <class Part, int D, class Real> bool owns(const Part& part, const SurfacePoint<D, Real>& surface) {
    if constexpr (requires { part.owns(surface); })
        return part.owns(surface);
    else
        return true;
}

/// True for a feature inside a flat face: not for corners, edges and round surfaces.
template <int D, class Real> bool is_on_face(const Shape<D, Real>& shape, std::uint32_t feature) {
    return std::visit(
        [&](const auto& held) {
            if constexpr (requires { held.is_face(feature); })
                return held.is_face(feature);
            else
                return false;
        },
        shape);
}

template <int D, class Real>
SurfacePoint<D, Real> to_world(const Pose<D, Real>& pose, const SurfacePoint<D, Real>& local) {
    return {pose.to_world(local.point), pose.turn(local.normal), local.distance, local.feature};
}

/// Calls visit(surface) with each contact of a sphere within `max_distance` of a shape. A sphere deeper than `depth`
/// behind a surface has passed it.
template <int D, class Real, class Visit>
void contacts_of_sphere(const Shape<D, Real>& shape, const Pose<D, Real>& pose, const Vec<D, Real>& center,
                        Real max_distance, Real depth, Visit&& visit) {
    const auto local = pose.to_local(center);
    BoundingBox<D, Real> near;
    near.include(local);
    std::visit(
        [&]<class Held>(const Held& held) {
            visit_parts(held, near.grown(max(max_distance, depth)), [&](const auto& part) {
                const auto surface = part.nearest(local);
                if (surface.distance > max_distance || (IsSurface<Held> && surface.distance < -depth)) return;
                if (owns(part, surface)) visit(to_world(pose, surface));
            });
        },
        shape);
}

/// Nearest point of a shape within `max_distance` of a point; nothing if there is none.
template <int D, class Real>
std::optional<SurfacePoint<D, Real>> nearest(const Shape<D, Real>& shape, const Pose<D, Real>& pose,
                                             const Vec<D, Real>& point, Real max_distance) {
    std::optional<SurfacePoint<D, Real>> best;
    contacts_of_sphere(shape, pose, point, max_distance, max_distance, [&](const SurfacePoint<D, Real>& surface) {
        if (!best || absolute(surface.distance) < absolute(best->distance)) best = surface;
    });
    return best;
}

/// Nearest approach of the segment a-b and a shape within `max_distance`.
template <int D, class Real>
std::optional<SegmentApproach<D, Real>> nearest_to_segment(const Shape<D, Real>& shape, const Pose<D, Real>& pose,
                                                           const Vec<D, Real>& a, const Vec<D, Real>& b,
                                                           Real max_distance) {
    std::optional<SegmentApproach<D, Real>> best;
    const auto local_a = pose.to_local(a), local_b = pose.to_local(b);
    BoundingBox<D, Real> near;
    near.include(local_a);
    near.include(local_b);
    const auto examine = [&](const auto& part) {
        const auto approach = nearest_to_segment(part, local_a, local_b);
        if (approach.surface.distance > max_distance || !owns(part, approach.surface)) return;
        if (!best || approach.surface.distance < best->surface.distance)
            best = {approach.t, to_world(pose, approach.surface)};
    };
    std::visit([&](const auto& held) { visit_parts(held, near.grown(max_distance), examine); }, shape);
    return best;
}

/// First contact of a moving sphere with a shape; of a ray for radius 0. Surfaces are met from their free side only.
template <int D, class Real>
std::optional<Impact<D, Real>> sweep(const Shape<D, Real>& shape, const Pose<D, Real>& pose, const Vec<D, Real>& from,
                                     const Vec<D, Real>& displacement, Real radius) {
    std::optional<Impact<D, Real>> first;
    const auto local = pose.to_local(from), along = pose.turn_back(displacement);
    BoundingBox<D, Real> near;
    near.include(local);
    near.include(local + along);
    const auto examine = [&](const auto& part) {
        const auto impact = sweep(part, local, along, radius);
        if (!impact || !owns(part, impact->surface) || (first && first->time <= impact->time)) return;
        if (requires { part.owns(impact->surface); } && impact->surface.distance < -radius) return;
        first = {impact->time, to_world(pose, impact->surface)};
    };
    std::visit([&](const auto& held) { visit_parts(held, near.grown(radius), examine); }, shape);
    return first;
}

} // namespace sinew::collide

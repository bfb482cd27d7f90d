#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/box.h"
#include "sinew/collide/capsule.h"
#include "sinew/collide/sphere.h"
#include "sinew/collide/triangle.h"

#include <algorithm>

namespace sinew::collide {

/// Sine of the angle up to which a side faces a direction.
template <class Real> inline constexpr Real level_side = Real(0.02);

/// True if edges from a corner of a triangle fall away from a direction.
template <class Real> bool falls_from(const Triangle<Real>& part, std::size_t corner, const Vec<3, Real>& along) {
    const auto corners = part.corners();
    const auto falls = [&](std::size_t other) {
        const auto side = corners[other % 3] - corners[corner];
        return dot(along, side) < -level_side<Real> * norm(side);
    };
    return falls(corner + 1) && falls(corner + 2);
}

/// Calls visit(point, radius, number) for the peaks of a surface within a box: corners from which all sides fall away
/// from a direction. The first of the triangles around a peak tells it.
template <class Surface, class Real, class Visit>
void each_peak(const Surface& surface, const Vec<3, Real>& along, const BoundingBox<3, Real>& near, Visit&& visit) {
    surface.parts_near(near, [&](const auto& part) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto peak = part.corners()[i];
            BoundingBox<3, Real> at;
            at.include(peak);
            if (!at.overlaps(near) || !falls_from(part, i, along)) continue;
            bool is_peak = true;
            surface.parts_near(at, [&](const auto& other) {
                const auto corners = other.corners();
                const auto same = std::size_t(std::ranges::find(corners, peak) - corners.begin());
                if (same < 3) is_peak = is_peak && other.number >= part.number && falls_from(other, same, along);
            });
            if (is_peak) visit(peak, Real(0), std::uint32_t(3 * part.number + i));
        }
    });
}

/// Calls visit(point, radius, number) for the points of a shape in space furthest along a direction of unit length,
/// both in the shape's frame: all corners of a side across the direction, and all peaks of a surface within a box.
template <class ShapeT, class Real, class Visit>
void each_extreme(const ShapeT& shape, const Vec<3, Real>& along, const BoundingBox<3, Real>& near, Visit&& visit) {
    constexpr Real level = level_side<Real>;
    if constexpr (std::is_same_v<ShapeT, Sphere<3, Real>>) {
        visit(Vec<3, Real>{}, shape.radius, 0U);
    } else if constexpr (std::is_same_v<ShapeT, Capsule<3, Real>>) {
        const Real rise = dot(along, direction(shape.b - shape.a));
        if (rise <= level) visit(shape.a, shape.radius, 0U);
        if (rise >= -level) visit(shape.b, shape.radius, 1U);
    } else if constexpr (std::is_same_v<ShapeT, Box<3, Real>>) {
        const auto far = shape.half();
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
            const auto sign = [&](int i) { return (corner >> i & 1U) != 0 ? Real(1) : Real(-1); };
            if (sign(0) * along[0] < -level || sign(1) * along[1] < -level || sign(2) * along[2] < -level) continue;
            visit(Vec<3, Real>::map([&](int i) { return sign(i) * far[i]; }), Real(0), corner);
        }
    } else if constexpr (requires { typename ShapeT::Part; }) {
        each_peak(shape, along, near, visit);
    }
}

} // namespace sinew::collide

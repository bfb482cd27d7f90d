#pragma once

#include "sinew/collide/box.h"
#include "sinew/collide/capsule.h"
#include "sinew/collide/sphere.h"

namespace sinew::collide {

/// Calls visit(point, radius, number) for the points of a round or sharp shape in space furthest along a direction of
/// unit length, both in the shape's frame: all corners of a side across the direction. Nothing for surfaces.
template <class ShapeT, class Real, class Visit>
void each_extreme(const ShapeT& shape, const Vec<3, Real>& along, Visit&& visit) {
    constexpr Real level = Real(0.02); // sine of the angle up to which a side faces a direction
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
    }
}

} // namespace sinew::collide

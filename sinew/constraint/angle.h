#pragma once

#include "sinew/constraint/evaluated.h"
#include "sinew/math/trig.h"

namespace sinew {

/// Angle between the directions a -> b and b -> c, radians; 0 where the three points are in line.
///     u = b - a,  v = c - b
///
///     2D   C = atan2(u x v, u . v)      signed, counter-clockwise positive in a y-up frame, in (-pi, pi]
///     3D   C = atan2(|u x v|, u . v)    in [0, pi]
///
/// Gradient: dC = dtheta_v - dtheta_u, and the direction of a leg changes by m / |leg| for a displacement of its end,
/// where m is the unit normal of the leg.
template <int D> struct Angle {
    static constexpr auto name = "angle";
    static constexpr int arity = 3;
    static constexpr Dimensions dimensions{2, 3};
    static constexpr int length_power = 0;
    static constexpr double period = D == 2 ? 2 * pi<double> : 0;
    static constexpr KindManual manual{
        .about = "Bend at the middle one of three particles: the turn from the direction a -> b to the "
                 "direction b -> c.",
        .drawing = "                  o c\n"
                   "                 /\n"
                   "                /  ) C\n"
                   "    o----------o- - - - -\n"
                   "    a          b\n",
        .particles = "a, b, c: an end, the joint, the other end. In the opposite order the sign in 2D is the "
                     "opposite",
        .zero = "where the three are in line, c beyond b; half a turn where c is folded back onto a",
        .sign = "2D: counter-clockwise positive on a screen with y up (clockwise with \"up\": \"-y\"), "
                "from -180 to 180, and any number of turns for limits that move. 3D: no sign, from 0 to "
                "180; limits are not negative",
        .use = "rest: a rigid bend; low and high: the range of a joint; drive: a motor; compliance: a "
               "bending spring",
        .example = "{\"kind\": \"angle\", \"between\": [\"shoulder\", \"elbow\", \"hand\"], \"low\": 0, "
                   "\"high\": 150}"};

    template <class T> static Evaluated<3, D, T> evaluate(const Points<3, D, T>& x) {
        const auto u = x[1] - x[0], v = x[2] - x[1];
        const auto [turn, across_u, across_v] = turn_and_normals(u, v);
        const auto du = across_u * inverse_or_zero(norm(u));
        const auto dv = across_v * inverse_or_zero(norm(v));
        return {turn, {du, -(du + dv), dv}};
    }

  private:
    /// The angle, and the unit normals of u and v in the direction of increasing angle.
    template <class T> struct Turn {
        T angle;
        Vec<D, T> across_u, across_v;
    };

    template <class T> static Turn<T> turn_and_normals(const Vec<2, T>& u, const Vec<2, T>& v) {
        return {arctangent(cross(u, v), dot(u, v)), perpendicular(direction(u)), perpendicular(direction(v))};
    }

    template <class T> static Turn<T> turn_and_normals(const Vec<3, T>& u, const Vec<3, T>& v) {
        const auto axis = cross(u, v);
        const auto hinge = direction(axis);
        return {arctangent(norm(axis), dot(u, v)), cross(hinge, direction(u)), cross(hinge, direction(v))};
    }
};

} // namespace sinew

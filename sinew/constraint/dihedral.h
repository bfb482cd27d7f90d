#pragma once

#include "sinew/constraint/evaluated.h"
#include "sinew/math/trig.h"

namespace sinew {

/// Bending angle across the edge b c shared by the triangles a b c and d c b, radians, in (-pi, pi]. The angle is 0
/// where the triangles are coplanar, positive where a and d are folded towards the side both normals point to.
///
///     e = c - b,   m = (b - a) x (c - a)   normal of a b c,   n = (c - d) x (b - d)   normal of d c b
///     C = atan2(-(m x n) . e/|e|, m . n)
///
/// Gradient after Bridson, Marino and Fedkiw 2003: |e| m / |m|^2 for a, |e| n / |n|^2 for d. The gradients of b and c
/// balance the sum, weighted by the positions of a and d along the edge.
template <int D> struct Dihedral {
    static constexpr auto name = "dihedral";
    static constexpr int arity = 4;
    static constexpr Dimensions dimensions{3, 3};
    static constexpr int length_power = 0;
    static constexpr double period = 2 * pi<double>;
    static constexpr KindManual manual{
        .about = "Fold between two triangles a b c and d c b across their common edge b c: stiffness of "
                 "paper and cloth.",
        .drawing = "            c o\n"
                   "             /|\\\n"
                   "            / | \\\n"
                   "         a o  |  o d      seen along the edge:   a o--__C__--o d\n"
                   "            \\ | /                                      b c\n"
                   "             \\|/\n"
                   "            b o\n",
        .particles = "a, b, c, d: the tip of one triangle, both ends of the edge, the tip of the other "
                     "triangle",
        .zero = "where the triangles are in one plane",
        .sign = "from -180 to 180; positive where a and d are folded to the side to which (b - a) x (c - "
                "a) points",
        .use = "rest: a fold; compliance: bending stiffness, 1 / (N m / rad)",
        .example = "{\"kind\": \"dihedral\", \"between\": [\"a\", \"b\", \"c\", \"d\"], \"rest\": 0, "
                   "\"compliance\": 0.01}"};

    template <class T> static Evaluated<4, 3, T> evaluate(const Points<4, 3, T>& x) {
        const auto &a = x[0], &b = x[1], &c = x[2], &d = x[3];
        const auto e = c - b;
        const auto m = cross(b - a, c - a), n = cross(c - d, b - d);
        const auto m1 = direction(m), n1 = direction(n);
        const T length = norm(e), per_length = inverse_or_zero(length);
        const auto da = m1 * (length * inverse_or_zero(norm(m))); // |m| / |e| is the height of a over the edge
        const auto dd = n1 * (length * inverse_or_zero(norm(n)));
        const T a_along = dot(a - b, e) * per_length * per_length; // 0 at b, 1 at c
        const T d_along = dot(d - b, e) * per_length * per_length;
        const auto dc = -(da * a_along + dd * d_along);
        const auto db = -(da * (T(1) - a_along) + dd * (T(1) - d_along));
        return {arctangent(-dot(cross(m1, n1), e * per_length), dot(m1, n1)), {da, db, dc, dd}};
    }
};

} // namespace sinew

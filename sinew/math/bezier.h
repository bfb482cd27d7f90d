#pragma once

#include "sinew/math/vec.h"

#include <array>

/// Bezier and Catmull-Rom curves, with parameter t in [0, 1].
namespace sinew {

///     B(t) = (1-t)^2 a + 2 (1-t) t b + t^2 c
template <int D, class T> struct QuadraticBezier {
    Vec<D, T> a, b, c; ///< from a to c, pulled towards b

    constexpr Vec<D, T> at(T t) const { return a * square(1 - t) + b * (2 * (1 - t) * t) + c * square(t); }
    ///     B'(t) = 2 (1-t) (b - a) + 2 t (c - b)
    constexpr Vec<D, T> derivative(T t) const { return (b - a) * (2 * (1 - t)) + (c - b) * (2 * t); }
};

///     B(t) = (1-t)^3 a + 3 (1-t)^2 t b + 3 (1-t) t^2 c + t^3 d
template <int D, class T> struct CubicBezier {
    Vec<D, T> a, b, c, d; ///< from a to d, leaving towards b, arriving from c

    constexpr Vec<D, T> at(T t) const {
        const T s = 1 - t;
        return a * (s * s * s) + b * (3 * s * s * t) + c * (3 * s * t * t) + d * (t * t * t);
    }
    ///     B'(t) = 3 (1-t)^2 (b - a) + 6 (1-t) t (c - b) + 3 t^2 (d - c)
    constexpr Vec<D, T> derivative(T t) const {
        const T s = 1 - t;
        return (b - a) * (3 * s * s) + (c - b) * (6 * s * t) + (d - c) * (3 * t * t);
    }
};

/// Degree elevation: the quadratic curve as a cubic one.
template <int D, class T> constexpr CubicBezier<D, T> elevated(const QuadraticBezier<D, T>& low) {
    constexpr T part = T(2) / 3;
    return {low.a, low.a + (low.b - low.a) * part, low.c + (low.b - low.c) * part, low.c};
}

/// Segment from b to c of the Catmull-Rom spline through a, b, c, d (Catmull and Rom 1974): the tangent at b is
/// parallel to c - a. Where the curve ends and a further point is missing, pass the end point itself in its place.
template <int D, class T>
constexpr CubicBezier<D, T> catmull_rom(const Vec<D, T>& a, const Vec<D, T>& b, const Vec<D, T>& c,
                                        const Vec<D, T>& d) {
    constexpr T sixth = T(1) / 6;
    return {b, b + (c - a) * sixth, c - (d - b) * sixth, c};
}

/// Arc length from 0 to t: five-point Gauss-Legendre quadrature of |B'| on eight equal parts. Relative error about 1e-6
/// for gently bent curves.
template <template <int, class> class Curve, int D, class T> T arc_length(const Curve<D, T>& curve, T t = T(1)) {
    struct Node {
        T position, weight;
    };
    constexpr std::array<Node, 5> nodes = {{{T(0), T(128.0 / 225)},
                                            {T(-0.53846931010568309), T(0.47862867049936647)},
                                            {T(0.53846931010568309), T(0.47862867049936647)},
                                            {T(-0.90617984593866399), T(0.23692688505618909)},
                                            {T(0.90617984593866399), T(0.23692688505618909)}}};
    constexpr int parts = 8;
    const T half = t / (2 * parts);
    T length = 0;
    for (int part = 0; part < parts; ++part)
        for (const auto& [position, weight] : nodes)
            length += weight * half * norm(curve.derivative(half * (T(2 * part + 1) + position)));
    return length;
}

} // namespace sinew

#pragma once

#include "sinew/math/vec.h"

#include <cmath>

namespace sinew::files {

/// An affine map of the plane: x * across + y * down + origin, as matrix(a b c d e f) of SVG.
struct Affine {
    Vec2<double> across{{1, 0}}, down{{0, 1}}, origin{};

    Vec2<double> operator()(const Vec2<double>& p) const { return vector(p) + origin; }
    Vec2<double> vector(const Vec2<double>& p) const { return across * p[0] + down * p[1]; }
    /// The map of `inner` first.
    Affine operator*(const Affine& inner) const {
        return {vector(inner.across), vector(inner.down), (*this)(inner.origin)};
    }

    /// Factor of lengths, if it is the same in all directions; else 0.
    double similarity() const {
        constexpr double little = 1e-9;
        const double scale = norm(across);
        const bool same =
            absolute(norm(down) - scale) <= little * scale && absolute(dot(across, down)) <= little * scale * scale;
        return same ? scale : 0;
    }
    /// Mean factor of lengths.
    double scale() const { return std::sqrt(std::abs(across[0] * down[1] - across[1] * down[0])); }
    bool is_mirrored() const { return across[0] * down[1] - across[1] * down[0] < 0; }
    /// Direction of the x axis, degrees.
    double turn() const { return std::atan2(across[1], across[0]) * (180 / pi<double>); }
};

inline Affine moved_by(const Vec2<double>& by) {
    return {{{1, 0}}, {{0, 1}}, by};
}
inline Affine scaled_by(double x, double y) {
    return {{{x, 0}}, {{0, y}}, {}};
}
/// Rotation by degrees, clockwise on a screen.
inline Affine turned_by(double degrees) {
    const double angle = degrees * (pi<double> / 180);
    return {{{std::cos(angle), std::sin(angle)}}, {{-std::sin(angle), std::cos(angle)}}, {}};
}

} // namespace sinew::files

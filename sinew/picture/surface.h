#pragma once

#include "sinew/math/color.h"
#include "sinew/session/view.h"

#include <array>
#include <optional>
#include <vector>

/// Lighting of cloth.
namespace sinew {

/// A quadrilateral of a surface: the corners in order around the cell, and the surface normals there.
struct Patch {
    std::array<Vec3<double>, 4> corner{}, normal{};
};

/// Normal of a patch, weighted by area: collapsed patches along a fold, whose threads point anywhere, count little. In
/// 2D, where cloth has no depth, the directions of the threads suggest the folds.
template <int D> Vec3<double> own_normal(const Patch& patch) {
    const auto& [a, b, c, d] = patch.corner;
    if constexpr (D == 3) return cross(c - a, d - b);
    constexpr double depth = 1.6; // apparent depth of folds
    const auto down = direction(d - a), along = direction(b - a);
    const double area = norm(cross(c - a, d - b));
    return direction(Vec3<double>{{-depth * down[0], -depth * along[1], 1}}) * area;
}

inline Vec3<double> flat(const Patch& patch, double u, double v) {
    const auto& [a, b, c, d] = patch.corner;
    return (a * (1 - u) + b * u) * (1 - v) + (d * (1 - u) + c * u) * v;
}

/// Point of the curved surface through the corners with the given normals (Phong tessellation: Boubekeur and Alexa
/// 2008); u along the first side, v along the last.
inline Vec3<double> bulge(const Patch& patch, double u, double v) {
    constexpr double roundness = 0.6;
    const std::array<double, 4> share = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
    const auto even = flat(patch, u, v);
    Vec3<double> round{};
    for (std::size_t i = 0; i < 4; ++i)
        round += (even - patch.normal[i] * dot(even - patch.corner[i], patch.normal[i])) * share[i];
    return even + (round - even) * roundness;
}

inline Vec3<double> normal_at(const Patch& patch, double u, double v) {
    const std::array<double, 4> share = {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
    Vec3<double> sum{};
    for (std::size_t i = 0; i < 4; ++i) sum += patch.normal[i] * share[i];
    return direction(sum);
}

/// Directional light from the upper left behind the viewer, with a specular highlight.
struct Light {
    Vec3<double> towards_light, towards_eye, above, halfway;
    Color ink;

    Light(const View& view, const Color& darkest)
        : towards_light(direction(view.towards_eye() * 0.7 + view.above() * 0.9 - view.right() * 0.75)),
          towards_eye(view.towards_eye()), above(view.above()), halfway(direction(towards_light + towards_eye)),
          ink(darkest) {}

    /// Shaded colour of a two-sided surface with this unit normal.
    Color shade(const Color& front, const Color& back, const Vec3<double>& normal) const {
        const bool is_front = dot(normal, towards_eye) >= 0;
        const auto n = is_front ? normal : -normal;
        const Color& color = is_front ? front : back;
        const double sky = 0.5 + 0.5 * dot(n, above);
        const double sun = max(0.0, 0.8 * dot(n, towards_light) + 0.2);
        const auto lit = float(0.2 * sky + 1.2 * sun);
        const double gleam = square(square(square(square(max(0.0, dot(n, halfway))))));
        // deep folds keep their hue
        Color dark = mix({color.red * 0.42F, color.green * 0.36F, color.blue * 0.42F, color.alpha}, ink, 0.12F);
        dark.alpha = color.alpha;
        const float glow = max(0.0F, lit - 1) * 0.5F + float(0.26 * gleam * gleam);
        return mix(mix(dark, color, min(1.0F, lit)), {1, 1, 1, color.alpha}, min(1.0F, glow));
    }
};

} // namespace sinew

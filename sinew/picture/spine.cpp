#include "sinew/picture/spine.h"

#include <algorithm>

namespace sinew {
namespace {

using Arc = CubicBezier<2, float>;

/// Chords per curve for measuring length: 1e-4 short on a quarter circle.
constexpr std::size_t chords = 32;

/// Unit tangent at t; at an end with a zero-length handle, the direction of a nearby secant.
Vec2<float> way_at(const Arc& bend, float t) {
    constexpr float aside = 0.01F;
    const auto way = bend.derivative(t);
    const auto nearby = bend.at(min(t + aside, 1.0F)) - bend.at(max(t - aside, 0.0F));
    return direction(dot(way, way) > 1e-6F ? way : nearby);
}

} // namespace

void limb_along(std::span<const Vec2<float>> points, Bends& bends) {
    bends.clear();
    if (points.size() == 2)
        bends.push_back(elevated(QuadraticBezier<2, float>{points[0], (points[0] + points[1]) * 0.5F, points[1]}));
    if (points.size() == 3) bends.push_back(elevated(QuadraticBezier<2, float>{points[0], points[1], points[2]}));
    if (points.size() == 4) bends.push_back({points[0], points[1], points[2], points[3]});
    if (points.size() > 4) rope_through(points, bends);
}

void rope_through(std::span<const Vec2<float>> points, Bends& bends) {
    bends.clear();
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        bends.push_back(catmull_rom(points[i == 0 ? 0 : i - 1], points[i], points[i + 1],
                                    points[std::min(i + 2, points.size() - 1)]));
}

void lay_out(std::span<const Arc> bends, std::size_t parts, float longest, Spine& spine) {
    spine.position.clear();
    spine.along.clear();
    spine.length = 0;
    if (bends.empty()) return;

    std::vector<float> length_until(1, 0.0F); // at the end of each chord
    length_until.reserve(bends.size() * chords + 1);
    for (const auto& bend : bends)
        for (std::size_t k = 0; k < chords; ++k) {
            spine.length += distance(bend.at(float(k) / chords), bend.at(float(k + 1) / chords));
            length_until.push_back(spine.length);
        }

    if (!is_finite(spine.length)) return; // overflow: nothing to draw

    const float wanted = min(spine.length / longest, float(max_parts - 1));
    parts = std::max({parts, std::size_t(1), std::size_t(wanted) + 1});
    std::size_t chord = 0;
    for (std::size_t i = 0; i <= parts; ++i) {
        const float length = spine.length * float(i) / float(parts);
        while (chord + 2 < length_until.size() && length_until[chord + 1] < length) ++chord;
        const float inside =
            (length - length_until[chord]) * inverse_or_zero(length_until[chord + 1] - length_until[chord]);
        const auto& bend = bends[chord / chords];
        const float t = (float(chord % chords) + clamp(inside, 0.0F, 1.0F)) / chords;
        spine.position.push_back(bend.at(t));
        spine.along.push_back(way_at(bend, t));
    }
}

float thickness_at(std::span<const double> profile, float share) {
    if (profile.empty()) return 1;
    const float position = clamp(share, 0.0F, 1.0F) * float(profile.size() - 1);
    const auto below = std::min(std::size_t(position), profile.size() - 1),
               above = std::min(below + 1, profile.size() - 1);
    return float(profile[below]) + (float(profile[above]) - float(profile[below])) * (position - float(below));
}

} // namespace sinew

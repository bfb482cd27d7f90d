#pragma once

#include "sinew/math/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace sinew::window {

/// Positive if the outline turns from x towards y.
inline float signed_area(std::span<const Vec2<float>> outline) {
    float twice = 0;
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        twice += cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
    return twice / 2;
}

inline bool is_convex(std::span<const Vec2<float>> outline) {
    bool left = false, right = false;
    float turn = 0; // changes of direction along x; more than two in a star
    const auto count = outline.size();
    for (std::size_t i = 0; i < count; ++i) {
        const auto a = outline[i], b = outline[(i + 1) % count], c = outline[(i + 2) % count];
        const float corner = cross(b - a, c - b);
        left = left || corner > 0;
        right = right || corner < 0;
        turn += (b[0] - a[0] > 0) != (c[0] - b[0] > 0) ? 1.0F : 0.0F;
    }
    return !(left && right) && turn <= 2;
}

/// Triangulates a simple polygon by cutting off ears; calls triangle(a, b, c) with indices of corners. An outline that
/// crosses itself is filled approximately. `rest` is scratch.
template <class Triangle>
void triangulate(std::span<const Vec2<float>> outline, std::vector<std::uint32_t>& rest, Triangle&& triangle) {
    const auto count = std::uint32_t(outline.size());
    if (is_convex(outline)) {
        for (std::uint32_t i = 1; i + 1 < count; ++i) triangle(0U, i, i + 1);
        return;
    }
    const float side = signed_area(outline) < 0 ? -1.0F : 1.0F;
    rest.clear();
    for (std::uint32_t i = 0; i < count; ++i) rest.push_back(i);
    const auto is_ear = [&](std::size_t at) {
        const auto n = rest.size();
        const auto &a = outline[rest[(at + n - 1) % n]], &b = outline[rest[at]], &c = outline[rest[(at + 1) % n]];
        if (cross(b - a, c - b) * side <= 0) return false;
        for (std::size_t i = 0; i < n; ++i) {
            if (i == at || i == (at + 1) % n || i == (at + n - 1) % n) continue;
            const auto& p = outline[rest[i]];
            if (cross(b - a, p - a) * side >= 0 && cross(c - b, p - b) * side >= 0 && cross(a - c, p - c) * side >= 0)
                return false;
        }
        return true;
    };
    std::size_t at = 0, failed = 0;
    while (rest.size() > 3 && failed <= rest.size()) {
        at %= rest.size();
        if (failed == rest.size() || is_ear(at)) { // without an ear, any corner is cut off
            const auto n = rest.size();
            triangle(rest[(at + n - 1) % n], rest[at], rest[(at + 1) % n]);
            rest.erase(rest.begin() + std::ptrdiff_t(at));
            failed = 0;
        } else {
            ++at, ++failed;
        }
    }
    if (rest.size() == 3) triangle(rest[0], rest[1], rest[2]);
}

} // namespace sinew::window

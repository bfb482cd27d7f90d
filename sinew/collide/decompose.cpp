#include "sinew/collide/decompose.h"

#include "sinew/collide/polygon.h"

#include <algorithm>
#include <optional>

namespace sinew::collide {
namespace {

using Point = Vec2<double>;

double turn(const Point& a, const Point& b, const Point& c) {
    return cross(b - a, c - a);
}

double area(std::span<const Point> corners) {
    double sum = 0;
    for (std::size_t i = 2; i < corners.size(); ++i) sum += turn(corners[0], corners[i - 1], corners[i]) / 2;
    return sum;
}

/// True if two segments have a point in common that is inside both.
bool cross_each_other(const Point& a, const Point& b, const Point& c, const Point& d) {
    return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

bool crosses_itself(std::span<const Point> corners) {
    const auto n = corners.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = i + 2; k < n; ++k)
            if (cross_each_other(corners[i], corners[(i + 1) % n], corners[k], corners[(k + 1) % n])) return true;
    return false;
}

/// Corners without those that are doubled or straight.
Corners without_flat_corners(Corners corners) {
    for (bool again = true; again && corners.size() >= 3;) {
        again = false;
        for (std::size_t i = 0; i < corners.size() && !again; ++i) {
            const auto n = corners.size();
            const auto &a = corners[(i + n - 1) % n], &b = corners[i], &c = corners[(i + 1) % n];
            if (std::abs(turn(a, b, c)) > 1e-12 * distance(a, b) * distance(b, c)) continue;
            corners.erase(corners.begin() + std::ptrdiff_t(i));
            again = true;
        }
    }
    return corners;
}

bool is_ear(const Corners& corners, std::size_t i) {
    const auto n = corners.size();
    const auto before = (i + n - 1) % n, after = (i + 1) % n;
    const auto &a = corners[before], &b = corners[i], &c = corners[after];
    if (!(turn(a, b, c) > 0)) return false;
    for (std::size_t k = 0; k < n; ++k) {
        if (k == before || k == i || k == after) continue;
        const auto& p = corners[k];
        if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
}

std::vector<Corners> triangles_of(Corners corners) {
    std::vector<Corners> triangles;
    while (corners.size() > 3) {
        std::size_t ear = 0;
        while (ear < corners.size() && !is_ear(corners, ear)) ++ear;
        if (ear == corners.size()) return {};
        const auto n = corners.size();
        triangles.push_back({corners[(ear + n - 1) % n], corners[ear], corners[(ear + 1) % n]});
        corners.erase(corners.begin() + std::ptrdiff_t(ear));
    }
    if (turn(corners[0], corners[1], corners[2]) > 0) triangles.push_back(corners);
    return triangles;
}

/// Both polygons as one, where they share an edge and the result is convex.
std::optional<Corners> merged(const Corners& a, const Corners& b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < b.size(); ++k) {
            if (!(a[i] == b[(k + 1) % b.size()] && a[(i + 1) % a.size()] == b[k])) continue;
            Corners whole;
            for (std::size_t j = 1; j <= a.size(); ++j) whole.push_back(a[(i + j) % a.size()]);
            for (std::size_t j = 2; j < b.size(); ++j) whole.push_back(b[(k + j) % b.size()]);
            whole = without_flat_corners(whole);
            if (is_convex<double>(whole)) return whole;
        }
    return std::nullopt;
}

} // namespace

std::vector<Corners> convex_parts(std::span<const Vec2<double>> corners) {
    Corners simple = without_flat_corners({corners.begin(), corners.end()});
    if (simple.size() < 3 || crosses_itself(simple)) return {};
    if (area(simple) < 0) std::reverse(simple.begin(), simple.end());
    auto parts = triangles_of(simple);
    for (std::size_t i = 0; i < parts.size(); ++i)
        for (std::size_t k = i + 1; k < parts.size();) {
            if (auto whole = merged(parts[i], parts[k])) {
                parts[i] = *whole;
                parts.erase(parts.begin() + std::ptrdiff_t(k));
                k = i + 1;
            } else {
                ++k;
            }
        }
    return parts;
}

} // namespace sinew::collide

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
        if (p == a || p == b || p == c) continue; // the other side of a bridge
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

/// Outline with a hole, which is joined to the corner that its rightmost one sees.
std::optional<Corners> bridged(const Corners& outline, Corners hole) {
    if (twice_area(hole) > 0) std::reverse(hole.begin(), hole.end());
    const auto right = std::max_element(hole.begin(), hole.end(), [](const Point& a, const Point& b) {
        return std::pair(a[0], a[1]) < std::pair(b[0], b[1]);
    });
    std::rotate(hole.begin(), right, hole.end());
    const auto sees = [&](std::size_t i) {
        const auto n = outline.size();
        for (std::size_t k = 0; k < n; ++k)
            if (cross_each_other(hole[0], outline[i], outline[k], outline[(k + 1) % n])) return false;
        const auto &before = outline[(i + n - 1) % n], &at = outline[i], &after = outline[(i + 1) % n];
        const bool is_left_of_both = turn(before, at, hole[0]) > 0 && turn(at, after, hole[0]) > 0;
        const bool is_left_of_one = turn(before, at, hole[0]) > 0 || turn(at, after, hole[0]) > 0;
        return turn(before, at, after) > 0 ? is_left_of_both : is_left_of_one;
    };
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (outline[i][0] >= hole[0][0] &&
            (!best || distance(outline[i], hole[0]) < distance(outline[*best], hole[0])) && sees(i))
            best = i;
    if (!best) return std::nullopt;
    Corners joined(outline.begin(), outline.begin() + std::ptrdiff_t(*best) + 1);
    joined.insert(joined.end(), hole.begin(), hole.end());
    joined.push_back(hole[0]);
    joined.insert(joined.end(), outline.begin() + std::ptrdiff_t(*best), outline.end());
    return joined;
}

/// Convex parts of an outline counter-clockwise.
std::vector<Corners> parts_of(const Corners& outline) {
    auto parts = triangles_of(outline);
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

} // namespace

double twice_area(std::span<const Point> corners) {
    double sum = 0;
    for (std::size_t i = 2; i < corners.size(); ++i) sum += turn(corners[0], corners[i - 1], corners[i]);
    return sum;
}

bool is_inside(std::span<const Point> corners, const Point& point) {
    bool inside = false;
    for (std::size_t i = 0, k = corners.size() - 1; i < corners.size(); k = i++) {
        const auto &a = corners[i], &b = corners[k];
        if ((a[1] > point[1]) == (b[1] > point[1])) continue;
        if (point[0] < a[0] + (b[0] - a[0]) * (point[1] - a[1]) / (b[1] - a[1])) inside = !inside;
    }
    return inside;
}

bool cross_each_other(std::span<const Point> a, std::span<const Point> b) {
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t k = 0; k < b.size(); ++k)
            if (cross_each_other(a[i], a[(i + 1) % a.size()], b[k], b[(k + 1) % b.size()])) return true;
    return false;
}

std::vector<Corners> convex_parts(std::span<const Vec2<double>> outline, std::span<const Corners> holes) {
    if (holes.empty()) return convex_parts(outline);
    Corners whole = without_flat_corners({outline.begin(), outline.end()});
    if (whole.size() < 3 || crosses_itself(whole)) return {};
    if (twice_area(whole) < 0) std::reverse(whole.begin(), whole.end());
    double left = twice_area(whole);
    std::vector<Corners> order(holes.begin(), holes.end());
    for (auto& hole : order) {
        hole = without_flat_corners(hole);
        if (hole.size() < 3 || crosses_itself(hole)) return {};
        left -= std::abs(twice_area(hole));
    }
    const auto rightmost = [](const Corners& hole) {
        double right = hole[0][0];
        for (const auto& corner : hole) right = std::max(right, corner[0]);
        return right;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](const Corners& a, const Corners& b) { return rightmost(a) > rightmost(b); });
    for (const auto& hole : order) {
        auto joined = bridged(whole, hole);
        if (!joined) return {};
        whole = std::move(*joined);
    }
    auto parts = parts_of(whole);
    double found = 0;
    for (const auto& part : parts) found += twice_area(part);
    constexpr double rounding = 1e-9;
    return std::abs(found - left) <= rounding * left ? parts : std::vector<Corners>{};
}

std::vector<Corners> convex_parts(std::span<const Vec2<double>> corners) {
    Corners simple = without_flat_corners({corners.begin(), corners.end()});
    if (simple.size() < 3 || crosses_itself(simple)) return {};
    if (twice_area(simple) < 0) std::reverse(simple.begin(), simple.end());
    return parts_of(simple);
}

} // namespace sinew::collide

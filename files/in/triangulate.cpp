#include "files/in/triangulate.h"

#include "sinew/collide/decompose.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

namespace sinew::files {
namespace {

using AreaPoint = Vec2<double>;
using AreaTriangle = std::array<std::size_t, 3>;
using AreaEdge = std::pair<std::size_t, std::size_t>;

AreaEdge edge_of(std::size_t a, std::size_t b) {
    return {std::min(a, b), std::max(a, b)};
}

double turn(const AreaPoint& a, const AreaPoint& b, const AreaPoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A triangle with its circumscribed circle.
struct Circled {
    AreaTriangle corners;
    AreaPoint center;
    double radius2; ///< squared
};

/// Points in general position: drawings put many on one line or circle, where Delaunay triangles are not unique. Shifts
/// are far below any error of an outline.
std::vector<AreaPoint> shaken(const std::vector<AreaPoint>& points, double size) {
    auto result = points;
    std::uint64_t state = 0x9e3779b97f4a7c15;
    const auto next = [&] {
        state = state * 6364136223846793005U + 1442695040888963407U;
        return double(state >> 40U) / double(1U << 24U) - 0.5;
    };
    for (auto& p : result) p += AreaPoint{{next(), next()}} * (1e-7 * size);
    return result;
}

class Delaunay {
  public:
    explicit Delaunay(const std::vector<AreaPoint>& points) {
        AreaPoint low = points[0], high = points[0];
        for (const auto& p : points)
            for (int i = 0; i < 2; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
        const double size = std::max(norm(high - low), 1e-9);
        points_ = shaken(points, size);
        const auto middle = (low + high) * 0.5;
        constexpr double far = 50; // times the size: corners of a triangle around all
        for (const auto& way : {AreaPoint{{-far, -far}}, AreaPoint{{far, -far}}, AreaPoint{{0, far}}})
            points_.push_back(middle + way * size);
        const auto n = points.size();
        add({n, n + 1, n + 2});
        for (std::size_t i = 0; i < n; ++i) insert(i);
        std::erase_if(triangles_,
                      [&](const Circled& t) { return std::ranges::any_of(t.corners, [&](auto c) { return c >= n; }); });
    }

    const std::vector<Circled>& triangles() const { return triangles_; }

  private:
    std::vector<AreaPoint> points_;
    std::vector<Circled> triangles_;

    void add(AreaTriangle t) {
        const auto &a = points_[t[0]], b = points_[t[1]] - a, c = points_[t[2]] - a;
        const double area = turn({}, b, c);
        if (area == 0) return;
        if (area < 0) std::swap(t[1], t[2]);
        const double bb = dot(b, b), cc = dot(c, c);
        const AreaPoint center{{(c[1] * bb - b[1] * cc) / (2 * area), (b[0] * cc - c[0] * bb) / (2 * area)}};
        triangles_.push_back({t, a + center, dot(center, center)});
    }

    void insert(std::size_t i) {
        std::map<AreaEdge, std::pair<int, AreaEdge>> rim; // edges of the hole: those of one removed triangle
        std::erase_if(triangles_, [&](const Circled& t) {
            const auto away = points_[i] - t.center;
            if (dot(away, away) > t.radius2) return false;
            for (std::size_t k = 0; k < 3; ++k) {
                auto& [count, edge] = rim[edge_of(t.corners[k], t.corners[(k + 1) % 3])];
                ++count, edge = {t.corners[k], t.corners[(k + 1) % 3]};
            }
            return true;
        });
        for (const auto& [key, found] : rim)
            if (found.first == 1) add({found.second.first, found.second.second, i});
    }
};

std::vector<AreaPoint> lattice_inside(const std::vector<Outline>& outlines, double spacing) {
    AreaPoint low = outlines[0][0], high = low;
    for (const auto& p : outlines[0])
        for (int i = 0; i < 2; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    const double row = spacing * std::sqrt(3) / 2, clear = 0.6 * spacing;
    std::vector<AreaPoint> points;
    int number = 0;
    for (double y = low[1] + row / 2; y < high[1]; y += row, ++number)
        for (double x = low[0] + (number % 2 == 0 ? 0.25 : 0.75) * spacing; x < high[0]; x += spacing) {
            const AreaPoint p{{x, y}};
            const auto near = [&](const Outline& o) {
                return std::ranges::any_of(o, [&](const auto& q) { return norm(p - q) < clear; });
            };
            if (is_in_area(outlines, p) && std::ranges::none_of(outlines, near)) points.push_back(p);
        }
    return points;
}

/// Halves edges of outlines that no triangle has. Returns their number.
std::size_t halve_missing(std::vector<Outline>& outlines, const std::set<AreaEdge>& edges) {
    std::size_t halved = 0, begin = 0;
    for (auto& outline : outlines) {
        Outline longer;
        const auto n = outline.size();
        for (std::size_t i = 0; i < n; ++i) {
            longer.push_back(outline[i]);
            const auto next = (i + 1) % n;
            if (edges.contains(edge_of(begin + i, begin + next))) continue;
            longer.push_back((outline[i] + outline[next]) * 0.5);
            ++halved;
        }
        begin += n;
        outline = std::move(longer);
    }
    return halved;
}

} // namespace

bool is_in_area(const std::vector<Outline>& outlines, const AreaPoint& point) {
    if (!collide::is_inside(outlines[0], point)) return false;
    return std::none_of(outlines.begin() + 1, outlines.end(),
                        [&](const auto& hole) { return collide::is_inside(hole, point); });
}

AreaMesh triangulated(std::vector<Outline> outlines, double spacing, std::size_t max_points) {
    const auto inner = spacing > 0 ? lattice_inside(outlines, spacing) : std::vector<AreaPoint>();
    constexpr int rounds = 12;
    for (int round = 0; round < rounds; ++round) {
        AreaMesh mesh;
        for (const auto& outline : outlines) {
            mesh.points.insert(mesh.points.end(), outline.begin(), outline.end());
            mesh.ends.push_back(mesh.points.size());
        }
        if (mesh.points.size() + inner.size() > max_points || mesh.points.size() < 3) return {};
        mesh.points.insert(mesh.points.end(), inner.begin(), inner.end());
        const Delaunay delaunay(mesh.points);
        std::set<AreaEdge> edges;
        for (const auto& t : delaunay.triangles())
            for (std::size_t k = 0; k < 3; ++k) edges.insert(edge_of(t.corners[k], t.corners[(k + 1) % 3]));
        if (halve_missing(outlines, edges) > 0) continue;
        for (const auto& t : delaunay.triangles()) {
            const auto& [a, b, c] = t.corners;
            if (is_in_area(outlines, (mesh.points[a] + mesh.points[b] + mesh.points[c]) * (1.0 / 3)))
                mesh.triangles.push_back(t.corners);
        }
        return mesh;
    }
    return {};
}

} // namespace sinew::files

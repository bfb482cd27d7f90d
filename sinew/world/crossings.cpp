#include "sinew/world/crossings.h"

#include "sinew/collide/broadphase.h"
#include "sinew/math/sort.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

namespace sinew {
namespace {

using Point3 = Vec3<double>;

/// Volume of a tetrahedron, times six; its sign is the side of d on the triangle a b c.
double volume(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
    return dot(cross(b - a, c - a), d - a);
}
double longest_square(std::span<const Point3> corners) {
    double longest = 0;
    for (std::size_t i = 1; i < corners.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const auto side = corners[i] - corners[k];
            longest = max(longest, dot(side, side));
        }
    return longest;
}
double farthest(std::span<const Point3> points) {
    double far = 0;
    for (const auto& point : points)
        for (int i = 0; i < 3; ++i) far = max(far, absolute(point[i]));
    return far;
}

/// Edges and triangles of all cloth, by rows of particles.
struct ClothFaces {
    std::vector<std::array<Row, 3>> triangles;
    std::vector<std::array<Row, 2>> edges;

    void add(const std::vector<Row>& corners) {
        const auto n = corners.size();
        for (std::size_t i = 2; i < n; ++i) {
            triangles.push_back({corners[0], corners[i - 1], corners[i]});
            if (i + 1 < n) add_edge(corners[0], corners[i]);
        }
        for (std::size_t i = 0; i < n; ++i) add_edge(corners[i], corners[(i + 1) % n]);
    }
    void add_edge(Row a, Row b) { edges.push_back({std::min(a, b), std::max(a, b)}); }
    void leave_each_edge_once() {
        sinew::sort(edges.begin(), edges.end());
        edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    }
};

template <class Real> ClothFaces faces_of(const World<3, Real>& world) {
    ClothFaces faces;
    for (const auto& figure : world.figures)
        for (const auto& piece : figure.pieces) {
            if (piece.mark != Mark::surface || piece.hidden) continue;
            std::vector<Row> corners;
            for (const auto id : piece.particles)
                if (const auto row = world.particles.handles.find(id)) corners.push_back(*row);
            if (corners.size() == piece.particles.size()) faces.add(corners);
        }
    faces.leave_each_edge_once();
    return faces;
}

template <class Real> class CrossingCounter {
  public:
    explicit CrossingCounter(const World<3, Real>& world) : world_(world), faces_(faces_of(world)) {}

    std::size_t count() {
        std::vector<collide::BoundingBox<3, double>> boxes;
        for (const auto& triangle : faces_.triangles) boxes.push_back(box_of(triangle));
        for (const auto& edge : faces_.edges) boxes.push_back(box_of(edge));
        const auto count = faces_.triangles.size();
        collide::Broadphase<3, double> broadphase;
        return broadphase
            .find(boxes,
                  [&](auto i, auto k) {
                      return i < count && k >= count && cross(faces_.triangles[i], faces_.edges[k - count]);
                  })
            .size();
    }

  private:
    const World<3, Real>& world_;
    ClothFaces faces_;

    Point3 position(Row row) const { return cast<double>(world_.particles.position[row]); }
    template <class Rows> collide::BoundingBox<3, double> box_of(const Rows& rows) const {
        collide::BoundingBox<3, double> box;
        for (const Row row : rows) box.include(position(row));
        return box;
    }
    bool cross(const std::array<Row, 3>& triangle, const std::array<Row, 2>& edge) const {
        for (const Row corner : triangle)
            if (corner == edge[0] || corner == edge[1]) return false;
        const std::array corners = {position(triangle[0]), position(triangle[1]), position(triangle[2]),
                                    position(edge[0]), position(edge[1])};
        const auto& [a, b, c, p, q] = corners;
        const double touching = volume_of_rounding(corners);
        const auto have_one_sign = [&](double v, double w) { return min(v, w) > touching || max(v, w) < -touching; };
        if (!have_one_sign(volume(a, b, c, p), -volume(a, b, c, q))) return false;
        const double ab = volume(p, q, a, b), bc = volume(p, q, b, c), ca = volume(p, q, c, a);
        return have_one_sign(ab, bc) && have_one_sign(bc, ca);
    }
    /// Volume up to which a tetrahedron of these corners may be flat: each of its three edges is known to a few units
    /// in the last place of the coordinates.
    static double volume_of_rounding(std::span<const Point3> corners) {
        constexpr double units = 8 * double(std::numeric_limits<Real>::epsilon());
        return units * farthest(corners) * longest_square(corners);
    }
};

} // namespace

template <int D, class Real> std::size_t count_crossings(const World<D, Real>& world) {
    if constexpr (D == 3)
        return CrossingCounter<Real>(world).count();
    else
        return 0;
}

#define SINEW_CROSSINGS(D, Real) template std::size_t count_crossings(const World<D, Real>&);
SINEW_INSTANTIATE(SINEW_CROSSINGS)

} // namespace sinew

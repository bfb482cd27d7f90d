#include "sinew/prefab/tetrahedra.h"

#include "sinew/assert/assert.h"
#include "sinew/collide/mesh.h"
#include "sinew/math/sort.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace sinew {
namespace {

using Point3 = Vec3<double>;
using Tetrahedron = std::array<std::uint32_t, 4>;

double signed_volume(const std::vector<Point3>& points, const Tetrahedron& t) {
    const auto a = points[t[0]];
    return dot(points[t[1]] - a, cross(points[t[2]] - a, points[t[3]] - a)) / 6;
}

/// Lattice of cube corners and cube centres over a box, one layer of cells wider on each side.
class Lattice {
  public:
    Lattice(const Solid& solid, int cells) : solid_(solid) {
        const auto [low, high] = solid.corners();
        const auto extent = high - low;
        const double longest = std::max({extent[0], extent[1], extent[2]});
        cell_ = longest / cells;
        for (int i = 0; i < 3; ++i) {
            count_[std::size_t(i)] = std::uint32_t(extent[i] / cell_ + 0.999) + 2;
            origin_[i] = (low[i] + high[i]) / 2 - cell_ * count_[std::size_t(i)] / 2;
        }
    }

    double cell() const { return cell_; }

    /// Tetrahedra inside, by points numbered in the order of their first use.
    TetraMesh inside() {
        TetraMesh mesh;
        find_nearness();
        for (std::uint32_t axis = 0; axis < 3; ++axis)
            for (std::uint32_t i = 0; i < count_[0]; ++i)
                for (std::uint32_t j = 0; j < count_[1]; ++j)
                    for (std::uint32_t k = 0; k < count_[2]; ++k) around_face(mesh, axis, {i, j, k});
        return mesh;
    }

  private:
    using Cell = std::array<std::uint32_t, 3>;
    const Solid& solid_;
    double cell_ = 1;
    Cell count_{};
    Point3 origin_{};
    std::vector<char> is_near_;          ///< by number of the lattice point: inside, or just outside
    std::vector<std::uint32_t> used_as_; ///< by number of the lattice point: its index in the mesh

    std::size_t corners() const { return std::size_t(count_[0] + 1) * (count_[1] + 1) * (count_[2] + 1); }
    std::size_t corner(const Cell& at) const {
        return (std::size_t(at[0]) * (count_[1] + 1) + at[1]) * (count_[2] + 1) + at[2];
    }
    std::size_t centre(const Cell& at) const {
        return corners() + (std::size_t(at[0]) * count_[1] + at[1]) * count_[2] + at[2];
    }
    Point3 position(const Cell& at, double offset) const {
        return origin_ + Point3::map([&](int i) { return (at[std::size_t(i)] + offset) * cell_; });
    }

    void find_nearness() {
        const auto all = corners() + std::size_t(count_[0]) * count_[1] * count_[2];
        is_near_.assign(all, 0);
        used_as_.assign(all, none);
        const auto note = [&](std::size_t number, const Point3& point) {
            Point3 on_surface;
            const bool is_near = solid_.contains(point) || solid_.nearest(point, cell_ / 4, on_surface);
            is_near_[number] = is_near;
        };
        for (std::uint32_t i = 0; i <= count_[0]; ++i)
            for (std::uint32_t j = 0; j <= count_[1]; ++j)
                for (std::uint32_t k = 0; k <= count_[2]; ++k) {
                    note(corner({i, j, k}), position({i, j, k}, 0));
                    if (i < count_[0] && j < count_[1] && k < count_[2])
                        note(centre({i, j, k}), position({i, j, k}, 0.5));
                }
    }

    static constexpr auto none = ~std::uint32_t(0);

    std::uint32_t use(TetraMesh& mesh, std::size_t number, const Point3& point) {
        if (used_as_[number] == none) {
            used_as_[number] = std::uint32_t(mesh.points.size());
            mesh.points.push_back(point);
        }
        return used_as_[number];
    }

    /// The four tetrahedra of two neighbouring centres and an edge of the face between their cells.
    void around_face(TetraMesh& mesh, std::uint32_t axis, const Cell& at) {
        if (at[axis] + 1 >= count_[axis]) return;
        Cell next = at;
        ++next[axis];
        if (!is_near_[centre(at)] || !is_near_[centre(next)]) return;
        const auto u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<Cell, 4> ring{next, next, next, next}; // corners of the face, all round
        ++ring[1][u], ++ring[2][u], ++ring[2][v], ++ring[3][v];
        for (std::size_t i = 0; i < 4; ++i) {
            const auto &p = ring[i], &q = ring[(i + 1) % 4];
            if (!is_near_[corner(p)] || !is_near_[corner(q)]) continue;
            Tetrahedron t{use(mesh, centre(at), position(at, 0.5)), use(mesh, centre(next), position(next, 0.5)),
                          use(mesh, corner(p), position(p, 0)), use(mesh, corner(q), position(q, 0))};
            if (signed_volume(mesh.points, t) < 0) std::swap(t[2], t[3]);
            mesh.tetrahedra.push_back(t);
        }
    }
};

/// Finds the edges, and the faces that belong to one tetrahedron only.
void find_edges_and_surface(TetraMesh& mesh) {
    std::vector<std::array<std::uint32_t, 6>> faces; // sorted corners, then the corners in order
    for (const auto& t : mesh.tetrahedra) {
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t k = i + 1; k < 4; ++k) mesh.edges.push_back({std::min(t[i], t[k]), std::max(t[i], t[k])});
        for (const auto& f : {std::array{t[0], t[2], t[1]}, std::array{t[0], t[1], t[3]}, std::array{t[1], t[2], t[3]},
                              std::array{t[2], t[0], t[3]}}) {
            auto sorted = f;
            sinew::sort(sorted.begin(), sorted.end());
            faces.push_back({sorted[0], sorted[1], sorted[2], f[0], f[1], f[2]});
        }
    }
    sinew::sort(mesh.edges);
    mesh.edges.erase(std::unique(mesh.edges.begin(), mesh.edges.end()), mesh.edges.end());
    sinew::sort(faces);
    const auto is_same = [&](std::size_t a, std::size_t b) {
        return a < faces.size() && b < faces.size() &&
               std::equal(faces[a].begin(), faces[a].begin() + 3, faces[b].begin());
    };
    for (std::size_t i = 0; i < faces.size(); ++i)
        if (!is_same(i, i + 1) && !(i > 0 && is_same(i, i - 1)))
            mesh.surface.push_back({faces[i][3], faces[i][4], faces[i][5]});
}

/// Moves the points of the surface to the surface of the solid, one after the other, each as far as leaves its
/// tetrahedra upright; again, since a neighbour's move makes room.
void fit(TetraMesh& mesh, const Solid& solid, double cell) {
    constexpr int rounds = 8, shares = 16;
    const double least = 0.2 * square(cell) * cell / 12; // of a lattice tetrahedron's volume, cell^3 / 12
    std::vector<std::vector<std::uint32_t>> around(mesh.points.size()); // tetrahedra of a point
    for (std::uint32_t i = 0; i < mesh.tetrahedra.size(); ++i)
        for (const auto corner : mesh.tetrahedra[i]) around[corner].push_back(i);
    std::vector<char> is_outer(mesh.points.size(), 0);
    for (const auto& triangle : mesh.surface)
        for (const auto corner : triangle) is_outer[corner] = 1;
    auto fitted = mesh.points;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        if (is_outer[i]) solid.nearest(mesh.points[i], cell, fitted[i]);
    const auto is_good = [&](std::uint32_t t) { return signed_volume(mesh.points, mesh.tetrahedra[t]) >= least; };
    for (int round = 0; round < rounds; ++round)
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            const auto from = mesh.points[i];
            for (int share = shares; share > 0 && from != fitted[i]; --share) {
                mesh.points[i] = from + (fitted[i] - from) * (double(share) / shares);
                if (std::ranges::all_of(around[i], is_good)) break;
                mesh.points[i] = from;
            }
        }
}

/// The inside of a mesh by the number of times that its faces wind around a point: the crossings of a ray upwards.
class MeshSolid final : public Solid {
  public:
    explicit MeshSolid(const MeshModel& model) : surface_(model.points, triangles_of(model)) {
        for (const auto& triangle : surface_.triangles())
            for (const auto corner : triangle) box_.include(surface_.corners()[corner]);
    }

    std::array<Point3, 2> corners() const override { return {box_.low, box_.high}; }

    bool contains(const Point3& point) const override {
        // A ray through an edge or a corner would be counted by all faces there or by none: a little aside it meets
        // one.
        const double aside = 1e-7 * norm(box_.high - box_.low);
        const Point3 from{{point[0] + aside, point[1] + 0.618 * aside, point[2]}};
        collide::BoundingBox<3, double> ray{from, from};
        ray.high[2] = box_.high[2];
        int turns = 0;
        surface_.parts_near(ray, [&](const collide::Triangle<double>& part) { turns += crossing(part, from); });
        return turns != 0;
    }

    bool nearest(const Point3& point, double reach, Point3& found) const override {
        double best = reach;
        bool any = false;
        surface_.parts_near(collide::BoundingBox<3, double>{point, point}.grown(reach),
                            [&](const collide::Triangle<double>& part) {
                                const auto on = part.nearest(point).point;
                                if (const double away = distance(on, point); away <= best)
                                    best = away, found = on, any = true;
                            });
        return any;
    }

  private:
    collide::Mesh<3, double> surface_;
    collide::BoundingBox<3, double> box_;

    /// Faces as fans of triangles.
    static std::vector<std::array<std::uint32_t, 3>> triangles_of(const MeshModel& model) {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        for (std::size_t i = 0; i < model.faces(); ++i) {
            const auto face = model.face(i);
            for (std::size_t k = 2; k < face.size(); ++k) triangles.push_back({face[0], face[k - 1], face[k]});
        }
        return triangles;
    }

    /// 1 or -1 where the vertical ray from a point leaves or enters through a triangle, else 0.
    static int crossing(const collide::Triangle<double>& part, const Point3& from) {
        const auto side = [&](const Point3& p, const Point3& q) {
            return (q[0] - p[0]) * (from[1] - p[1]) - (q[1] - p[1]) * (from[0] - p[0]);
        };
        const double ab = side(part.a, part.b), bc = side(part.b, part.c), ca = side(part.c, part.a);
        const bool left = ab > 0 && bc > 0 && ca > 0, right = ab < 0 && bc < 0 && ca < 0;
        if (!left && !right) return 0;
        const double z = (part.a[2] * bc + part.b[2] * ca + part.c[2] * ab) / (ab + bc + ca);
        return z <= from[2] ? 0 : left ? 1 : -1;
    }
};

} // namespace

std::array<Vec3<double>, 2> BallSolid::corners() const {
    return {Point3{{-radius_, -radius_, -radius_}}, Point3{{radius_, radius_, radius_}}};
}

bool BallSolid::nearest(const Vec3<double>& point, double reach, Vec3<double>& found) const {
    if (absolute(norm(point) - radius_) > reach) return false;
    const auto out = direction(point);
    found = (out == Point3{} ? Point3::axis(0) : out) * radius_;
    return true;
}

TetraMesh fill_with_tetrahedra(const Solid& solid, int cells) {
    SINEW_ASSERT(cells > 0, "a lattice has cells");
    const auto [low, high] = solid.corners();
    if (const auto extent = high - low; !(max(max(extent[0], extent[1]), extent[2]) > 0)) return {};
    Lattice lattice(solid, cells);
    auto mesh = lattice.inside();
    find_edges_and_surface(mesh);
    fit(mesh, solid, lattice.cell());
    return mesh;
}

TetraMesh fill_with_tetrahedra(const MeshModel& model, int cells) {
    return fill_with_tetrahedra(MeshSolid(model), cells);
}

std::size_t open_edges(const MeshModel& model) {
    std::vector<std::array<std::uint32_t, 2>> edges;
    for (std::size_t i = 0; i < model.faces(); ++i) {
        const auto face = model.face(i);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const auto a = face[k], b = face[(k + 1) % face.size()];
            edges.push_back({std::min(a, b), std::max(a, b)});
        }
    }
    sinew::sort(edges);
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        auto end = i;
        while (end < edges.size() && edges[end] == edges[i]) ++end;
        open += (end - i) % 2; // more than two faces may meet in an edge
        i = end;
    }
    return open;
}

} // namespace sinew

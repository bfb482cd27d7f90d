#include "sinew/topology/slice.h"

#include "sinew/topology/virtual_node.h"
#include "sinew/world/changes.h"
#include "sinew/world/constraint_graph.h"

namespace sinew {
namespace {

using Uv = Vec2<float>;
using Positions = std::array<Vec3<double>, 4>;

/// Cell before slicing: corner positions in 3D, and the particle corners.
struct Cell {
    Positions position{};
    std::array<std::optional<ParticleId>, 4> particle{};
};

template <int D, class Real> Vec3<double> in_space(const World<D, Real>& world, ParticleId id) {
    Vec3<double> wide{};
    if (const auto row = row_of(world, id))
        for (int i = 0; i < D; ++i) wide[i] = double(world.particles.position[*row][i]);
    return wide;
}

template <int D, class Real> Cell cell_of(const World<D, Real>& world, const Figure& figure, const Piece& piece) {
    Cell cell;
    const auto position = [&](std::size_t i) { return in_space(world, piece.particles[i]); };
    for (std::size_t i = 0; i < 4; ++i) {
        if (piece.mark == Mark::fragment) {
            const auto& corner = figure.fragments[piece.fragment].corners[i];
            cell.position[i] = position_of(corner, position, D == 2);
            if (corner.is_particle()) cell.particle[i] = piece.particles[corner.of[0]];
        } else {
            cell.position[i] = position(i);
            cell.particle[i] = piece.particles[i];
        }
    }
    return cell;
}

Vec3<double> bilinear(const Positions& corner, const Uv& at) {
    const double u = double(at[0]), v = double(at[1]);
    return (corner[0] * (1 - u) + corner[1] * u) * (1 - v) + (corner[3] * (1 - u) + corner[2] * u) * v;
}

constexpr std::array<Uv, 4> corner_uv = {{{{0, 0}}, {{1, 0}}, {{1, 1}}, {{0, 1}}}};

/// Tiles of a piece; a whole cell has an even grid.
template <class Visit> void each_tile(const Figure& figure, const Piece& piece, Visit&& visit) {
    if (piece.mark == Mark::fragment) return figure.fragments[piece.fragment].each_tile(visit);
    constexpr int parts = 4;
    constexpr float side = 1.0F / parts;
    for (int row = 0; row < parts; ++row)
        for (int column = 0; column < parts; ++column) {
            std::array<Uv, 4> tile = corner_uv;
            for (auto& uv : tile) uv = (uv + Uv{{float(column), float(row)}}) * side;
            visit(std::span<const Uv>(tile));
        }
}

/// Adds a fragment with the particle corners of the cell, and the others unbound.
void add_piece(const Piece& whole, const Cell& cell, Fragment fragment, PiecesLeft& left) {
    Piece piece = whole;
    piece.mark = Mark::fragment;
    piece.particles.clear();
    for (std::size_t i = 0; i < 4; ++i) {
        auto& corner = fragment.corners[i];
        corner = {.count = 0, .at = cell.position[i]};
        if (!cell.particle[i]) continue;
        corner = {.of = {std::uint8_t(piece.particles.size())}, .count = 1};
        piece.particles.push_back(*cell.particle[i]);
    }
    piece.fragment = std::uint32_t(left.fragments.size());
    left.fragments.push_back(std::move(fragment));
    left.pieces.push_back(std::move(piece));
}

/// Corner of a tile, with picture coordinates along the blade from `from`, and to the left.
struct Corner {
    Uv uv{};
    double along = 0, beside = 0;
};

/// Points with sign * coordinate >= least.
struct HalfPlane {
    double Corner::*coordinate;
    double sign = 1, min = 0;

    double depth(const Corner& corner) const { return sign * corner.*coordinate - min; }
};

/// A blade's view of a cell.
template <int D> struct BladeView {
    const Positions& position;
    const Blade& blade;
    const Projection<D>& see;
    Vec2<double> along;

    Corner at(const Uv& uv) const {
        const auto space = bilinear(position, uv);
        const auto seen = see(Vec<D, double>::map([&](int i) { return space[i]; })) - blade.from;
        return {uv, dot(seen, along), cross(along, seen)};
    }

    /// Intersection of an edge with the boundary of a half plane, by regula falsi: bilinear maps and perspective are
    /// not quite linear.
    Corner entry(Corner out, Corner in, const HalfPlane& half) const {
        constexpr int max = 4;
        Corner met = in;
        for (int i = 0; i < max; ++i) {
            const double a = half.depth(out), b = half.depth(in);
            if (!(b > a)) return met;
            met = at(out.uv + (in.uv - out.uv) * float(-a / (b - a)));
            const double depth = half.depth(met);
            if (depth == 0) return met;
            (depth < 0 ? out : in) = met;
        }
        return met;
    }

    /// Clips a polygon to a half plane (Sutherland and Hodgman 1974).
    void clip(const std::vector<Corner>& polygon, const HalfPlane& half, std::vector<Corner>& inside) const {
        inside.clear();
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const bool has_a = half.depth(a) >= 0, has_b = half.depth(b) >= 0;
            if (has_a) inside.push_back(a);
            if (has_a != has_b) inside.push_back(has_a ? entry(b, a, half) : entry(a, b, half));
        }
    }
};

double area_of(std::span<const Corner> polygon) {
    double twice = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        twice += double(cross(polygon[i - 1].uv - polygon[0].uv, polygon[i].uv - polygon[0].uv));
    return absolute(twice) / 2;
}

/// Regions around a blade of half thickness `radius`: left, right, behind and ahead.
std::array<std::vector<HalfPlane>, 4> sides_of(double radius, double length) {
    const HalfPlane above_low{&Corner::beside, 1, -radius}, below_high{&Corner::beside, -1, -radius};
    return {{{{&Corner::beside, 1, radius}},
             {{&Corner::beside, -1, radius}},
             {above_low, below_high, {&Corner::along, -1, radius}},
             {above_low, below_high, {&Corner::along, 1, length + radius}}}};
}

template <int D, class Real> bool is_linked(const World<D, Real>& world, ParticleId a, ParticleId b) {
    const auto from = row_of(world, a), to = row_of(world, b);
    if (!from || !to) return false;
    if (*from == *to) return true; // a triangle's corner counts as two
    bool linked = false;
    for_each_link(world, *from, [&](Row, Row other) { linked = linked || other == *to; });
    return linked;
}

/// UnfoldedTriangles of a part: particles at corners of the part, and particles joined to one by a side of the cell.
template <int D, class Real> Cell corners_of(const World<D, Real>& world, const Cell& cell, const Fragment& part) {
    std::array<bool, 4> own{};
    for (std::size_t i = 0; i < 4; ++i)
        own[i] =
            cell.particle[i] && std::find(part.points.begin(), part.points.end(), corner_uv[i]) != part.points.end();
    Cell kept{.position = cell.position};
    for (std::size_t i = 0; i < 4; ++i) {
        if (!cell.particle[i]) continue;
        const auto joined = [&](std::size_t k) {
            return own[k] && is_linked(world, *cell.particle[i], *cell.particle[k]);
        };
        if (own[i] || joined((i + 1) % 4) || joined((i + 3) % 4)) kept.particle[i] = cell.particle[i];
    }
    return kept;
}

bool has_own_corner(const Cell& cell, const Fragment& part) {
    for (std::size_t i = 0; i < 4; ++i)
        if (cell.particle[i] && std::find(part.points.begin(), part.points.end(), corner_uv[i]) != part.points.end())
            return true;
    return false;
}

} // namespace

template <int D, class Real>
Slicer<D, Real>::Slicer(const World<D, Real>& world, const Blade& blade, const Projection<D>& see)
    : world_(world), blade_(blade), see_(see), along_(direction(blade.to - blade.from)),
      length_(distance(blade.from, blade.to)) {
    if (along_ == Vec2<double>{}) along_ = {{1, 0}};
}

template <int D, class Real> bool Slicer<D, Real>::runs_through(const Figure& figure, const Piece& piece) const {
    const auto cell = cell_of(world_, figure, piece);
    const BladeView<D> view{cell.position, blade_, see_, along_};
    const double radius = blade_.radius;
    bool left = false, right = false, near = false;
    each_tile(figure, piece, [&](std::span<const Uv> tile) {
        for (const auto& uv : tile) {
            const auto corner = view.at(uv);
            left = left || corner.beside > -radius;
            right = right || corner.beside < radius;
            near = near || (corner.along > -radius && corner.along < length_ + radius);
        }
    });
    return left && right && near;
}

template <int D, class Real>
void Slicer<D, Real>::slice(const Figure& figure, const Piece& piece, PiecesLeft& left) const {
    constexpr double min_area = 1e-6; // relative to the cell
    const auto cell = cell_of(world_, figure, piece);
    const BladeView<D> view{cell.position, blade_, see_, along_};
    std::vector<Corner> polygon, clipped;
    std::vector<Uv> tile;
    for (const auto& side : sides_of(blade_.radius, length_)) {
        Fragment part;
        each_tile(figure, piece, [&](std::span<const Uv> whole) {
            polygon.clear();
            for (const auto& uv : whole) polygon.push_back(view.at(uv));
            for (const auto& half : side) {
                view.clip(polygon, half, clipped);
                std::swap(polygon, clipped);
            }
            if (!(area_of(polygon) > min_area)) return;
            tile.clear();
            for (const auto& corner : polygon) tile.push_back(corner.uv);
            part.add_tile(tile);
        });
        if (!has_own_corner(cell, part)) continue;
        const auto kept = corners_of(world_, cell, part);
        add_piece(piece, kept, std::move(part), left);
    }
}

template <int D, class Real>
void add_unbound(const World<D, Real>& world, const Figure& figure, const Piece& piece, PiecesLeft& left) {
    add_piece(piece, cell_of(world, figure, piece), figure.fragments[piece.fragment], left);
}

template <int D, class Real> void bind(World<D, Real>& world) {
    for (auto& figure : world.figures) {
        if (figure.fragments.empty()) continue;
        detail::list_constraints(world);
        const NodeBinder<D, Real> binder(world);
        for (auto& piece : figure.pieces)
            if (piece.mark == Mark::fragment) binder.bind(piece, figure.fragments[piece.fragment]);
    }
}

#define SINEW_SLICE(D, Real)                                                                                           \
    template class Slicer<D, Real>;                                                                                    \
    template void add_unbound(const World<D, Real>&, const Figure&, const Piece&, PiecesLeft&);                        \
    template void bind(World<D, Real>&);
SINEW_INSTANTIATE(SINEW_SLICE)

} // namespace sinew

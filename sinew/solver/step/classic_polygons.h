#pragma once

#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/world/world.h"

#include <limits>
#include <optional>

/// Collisions of filled polygons in classic mode, as in the tutorials: the separating axis of least overlap, then a
/// push of one corner against one edge (Bitterli, A Verlet based approach for 2D game physics, 2009). Convex polygons
/// only.
namespace sinew::detail {

template <class Real> class ClassicPolygons {
  public:
    using Vector = Vec2<Real>;

    explicit ClassicPolygons(World<2, Real>& world) : world_(world), p_(world.particles) {}

    /// Parts every pair of polygons of figures that touch each other, in the order of the figures. push(row,
    /// displacement) moves a particle.
    template <class Push> void part_all(Push&& push) const {
        for (FigureIndex i = 0; i < world_.figures.size(); ++i)
            each_polygon(i, [&](const Piece& one) {
                for (FigureIndex k = i + 1; k < world_.figures.size(); ++k)
                    if (touch(world_.figures[i].filter, world_.figures[k].filter))
                        each_polygon(k, [&](const Piece& other) { part(one, other, push); });
            });
    }

  private:
    World<2, Real>& world_;
    const Particles<2, Real>& p_;

    /// Overlap of two polygons: the corner is of `pushed`, the edge of `edged`.
    struct Overlap {
        Real depth = std::numeric_limits<Real>::max();
        Vector normal{}; ///< from `edged` to `pushed`
        const Piece *pushed = nullptr, *edged = nullptr;
        std::size_t edge = 0; ///< from this corner to the next
    };
    struct Range {
        Real low = std::numeric_limits<Real>::max(), high = -low;
        void include(Real number) { low = min(low, number), high = max(high, number); }
    };

    template <class Visit> void each_polygon(FigureIndex index, Visit&& visit) const {
        const auto& figure = world_.figures[index];
        if (!figure.in_use() || !figure.collides || figure.quarantined) return;
        for (const auto& piece : figure.pieces)
            if (piece.mark == Mark::fill && !piece.hidden && is_whole(piece)) visit(piece);
    }
    bool is_whole(const Piece& piece) const {
        for (const auto id : piece.particles)
            if (!p_.handles.find(id)) return false;
        return piece.particles.size() >= 3;
    }

    Row row(const Piece& piece, std::size_t i) const {
        return *p_.handles.find(piece.particles[i % piece.particles.size()]);
    }
    Vector corner(const Piece& piece, std::size_t i) const { return p_.position[row(piece, i)]; }
    Vector middle(const Piece& piece) const {
        Vector sum{};
        for (std::size_t i = 0; i < piece.particles.size(); ++i) sum += corner(piece, i);
        return sum * (Real(1) / Real(piece.particles.size()));
    }
    Range range(const Piece& piece, const Vector& axis) const {
        Range range;
        for (std::size_t i = 0; i < piece.particles.size(); ++i) range.include(dot(axis, corner(piece, i)));
        return range;
    }

    template <class Push> void part(const Piece& one, const Piece& other, Push&& push) const {
        Overlap overlap;
        if (!find_overlap(one, other, overlap) || !find_overlap(other, one, overlap) || !overlap.edged) return;
        if (dot(overlap.normal, middle(*overlap.pushed) - middle(*overlap.edged)) < Real(0))
            overlap.normal = -overlap.normal;
        push_apart(overlap, deepest_corner(overlap), push);
    }

    /// False if an edge of `edged` parts the two; otherwise the axis of least overlap so far.
    bool find_overlap(const Piece& edged, const Piece& pushed, Overlap& smallest) const {
        for (std::size_t i = 0; i < edged.particles.size(); ++i) {
            const auto axis = direction(perpendicular(corner(edged, i + 1) - corner(edged, i)));
            if (axis == Vector{}) continue;
            const auto a = range(edged, axis), b = range(pushed, axis);
            const Real depth = min(a.high, b.high) - max(a.low, b.low);
            if (!(depth > Real(0))) return false;
            const Real shortest = min(a.high - b.low, b.high - a.low);
            if (shortest < smallest.depth) smallest = {shortest, axis, &pushed, &edged, i};
        }
        return true;
    }
    std::size_t deepest_corner(const Overlap& overlap) const {
        std::size_t deepest = 0;
        Real min = std::numeric_limits<Real>::max();
        for (std::size_t i = 0; i < overlap.pushed->particles.size(); ++i) {
            const Real along = dot(overlap.normal, corner(*overlap.pushed, i));
            if (along < min) min = along, deepest = i;
        }
        return deepest;
    }

    /// The corner moves by half of the depth; the ends of the edge by as much that the point struck, a share t along
    /// the edge, moves by the other half: shares 1 - t and t over t^2 + (1 - t)^2.
    template <class Push> void push_apart(const Overlap& overlap, std::size_t corner_number, Push&& push) const {
        const auto a = corner(*overlap.edged, overlap.edge), b = corner(*overlap.edged, overlap.edge + 1);
        const auto struck = corner(*overlap.pushed, corner_number) + overlap.normal * overlap.depth;
        const Real t = clamp(dot(struck - a, b - a) * inverse_or_zero(dot(b - a, b - a)), Real(0), Real(1));
        const auto half = overlap.normal * (overlap.depth * Real(0.5));
        const Real share = Real(1) / (t * t + square(Real(1) - t));
        push(row(*overlap.edged, overlap.edge), -half * ((Real(1) - t) * share));
        push(row(*overlap.edged, overlap.edge + 1), -half * (t * share));
        push(row(*overlap.pushed, corner_number), half);
    }
};

} // namespace sinew::detail

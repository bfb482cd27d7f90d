#pragma once

#include "sinew/collide/segment.h"
#include "sinew/world/world.h"

#include <span>

/// Shape of a figure as it is drawn, for sensors, rays and questions: spheres at its particles, capsules along its
/// lines, and the insides of its filled outlines.
namespace sinew {

/// Closed outlines and lines between particles are capsules.
inline bool has_segments(const Piece& piece) {
    return !piece.hidden && (piece.mark == Mark::stroke || piece.mark == Mark::curve || piece.mark == Mark::limb ||
                             piece.mark == Mark::loop || piece.mark == Mark::fill || piece.mark == Mark::ring);
}
inline bool is_closed(const Piece& piece) {
    return piece.mark == Mark::loop || piece.mark == Mark::fill;
}

template <int D, class Real> class BodyShape {
  public:
    using Vector = Vec<D, Real>;
    static constexpr auto none = ~Row(0);

    BodyShape(const World<D, Real>& world, const Figure& figure) : world_(world), figure_(figure) {}

    /// Calls visit(a, b, radius) with the rows of the ends of each line.
    template <class Visit> void each_segment(Visit&& visit) const {
        for (const auto& piece : figure_.pieces) {
            if (!has_segments(piece)) continue;
            const auto n = piece.particles.size();
            for (std::size_t i = 0; i + (is_closed(piece) ? 0 : 1) < n; ++i) {
                const Row a = row_at(piece, i), b = row_at(piece, i + 1);
                if (a != none && b != none && a != b)
                    visit(a, b, min(world_.particles.radius[a], world_.particles.radius[b]));
            }
        }
    }

    /// Row of a particle of the filled outline that encloses a point; `none` outside. In 3D filled outlines are
    /// faces of a closed surface.
    Row solid_around(const Vector& point) const {
        if constexpr (D == 2) {
            for (const auto& piece : figure_.pieces)
                if (is_solid(piece) && encloses(piece, point)) return row_at(piece, 0);
        } else {
            int ahead = 0, behind = 0;
            Row row = none;
            for (const auto& piece : figure_.pieces) {
                if (!is_solid(piece)) continue;
                if (row == none) row = row_at(piece, 0);
                for (std::size_t i = 2; i < piece.particles.size(); ++i) {
                    const auto met = crossing(piece, i, point);
                    ahead += met > 0, behind += met < 0;
                }
            }
            if (ahead % 2 == 1 && behind % 2 == 1) return row;
        }
        return none;
    }

  private:
    const World<D, Real>& world_;
    const Figure& figure_;

    static bool is_solid(const Piece& piece) {
        return !piece.hidden && piece.mark == Mark::fill && piece.particles.size() > 2;
    }
    Row row_at(const Piece& piece, std::size_t i) const {
        return world_.particles.handles.find(piece.particles[i % piece.particles.size()]).value_or(none);
    }
    Vector place(const Piece& piece, std::size_t i) const {
        const Row row = row_at(piece, i);
        return row == none ? Vector{} : world_.particles.position[row];
    }
    /// Ray to the right: it crosses the outline an odd number of times.
    bool encloses(const Piece& piece, const Vector& point) const {
        bool inside = false;
        for (std::size_t i = 0; i < piece.particles.size(); ++i) {
            if (row_at(piece, i) == none) return false;
            const auto a = place(piece, i) - point, b = place(piece, i + 1) - point;
            if ((a[1] > Real(0)) == (b[1] > Real(0))) continue;
            const bool is_left = a[0] * (b[1] - a[1]) < (b[0] - a[0]) * a[1];
            if (is_left == (b[1] > a[1])) inside = !inside;
        }
        return inside;
    }
    /// Side on which a line through a point, along no edge of anything straight, meets a triangle of a face: 1 ahead,
    /// -1 behind, 0 nowhere (Moeller and Trumbore 1997).
    int crossing(const Piece& piece, std::size_t i, const Vector& point) const {
        if constexpr (D == 3) {
            const Vector along{{Real(0.8191), Real(0.3371), Real(0.4642)}};
            const auto a = place(piece, 0), u = place(piece, i - 1) - a, v = place(piece, i) - a, from = point - a;
            const auto p = cross(along, v), q = cross(from, u);
            const Real per = inverse_or_zero(absolute(dot(u, p))) * (dot(u, p) < Real(0) ? Real(-1) : Real(1));
            const Real s = dot(from, p) * per, t = dot(along, q) * per;
            if (per == Real(0) || s < Real(0) || t < Real(0) || s + t > Real(1)) return 0;
            return dot(v, q) * per > Real(0) ? 1 : -1;
        }
        return 0;
    }
};

} // namespace sinew

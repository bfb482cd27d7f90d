#pragma once

#include "sinew/solver/contact/segment_normals.h"

#include <limits>

/// Solids in the plane: filled outlines. Two that overlap part along the side on which they overlap least.
namespace sinew::detail {

template <int D, class Real> class Solids {
  public:
    using Vector = Vec<D, Real>;
    static constexpr auto none = ~std::uint32_t(0);

    Solids(const ContactRoom<D, Real>& room, const SweepState<D, Real>& state) : room_(room), state_(state) {}

    /// True if two convex solids overlap by more than their radii.
    bool overlap(std::uint32_t a, std::uint32_t b) const {
        const auto is_crossed_by = [this](std::uint32_t other) {
            return [this, other](const ContactSegment& side) { return separation(side, other) < Real(0); };
        };
        return is_convex(a) && is_convex(b) && all_of(a, is_crossed_by(b)) && all_of(b, is_crossed_by(a));
    }
    collide::BoundingBox<D, Real> box_of(std::uint32_t solid) const {
        collide::BoundingBox<D, Real> box;
        all_of(solid, [&](const ContactSegment& s) {
            box.include(corner(s));
            return true;
        });
        return box;
    }
    /// First segment of the outline with a corner at a particle; `none` if there is none.
    std::uint32_t of(std::uint32_t particle) const {
        for (auto k = room_.first_segment_at[particle]; k < room_.first_segment_at[particle + 1]; ++k)
            if (const auto& s = room_.segments[room_.segments_at[k]]; s.side != 0) return s.first;
        return none;
    }
    /// True if a point is inside, or no further outside than `slack`. Convex outlines.
    bool contains(std::uint32_t solid, const Vector& x, Real slack) const {
        return solid != none && is_convex(solid) &&
               all_of(solid, [&](const ContactSegment& s) { return beyond(s, x) <= slack; });
    }
    /// True if a side that a particle at x is behind is the way out of its solid: for a corner of a convex solid the
    /// side, of both, on which they overlap least; else the nearest side. Beyond an inner side there is another solid.
    bool is_way_out(std::uint32_t particle, const Vector& x, const ContactSegment& s) const {
        const auto other = of(particle);
        const Real depth = beyond(s, x);
        if (other == none || other == s.first || !is_convex(other) || !is_convex(s.first))
            return all_of(s.first, [&](const ContactSegment& side) {
                return !(beyond(side, x) > (side.is_inner ? Real(0) : depth));
            });
        const Real least = separation(s, other);
        const auto is_no_better = [&](std::uint32_t from) {
            return [this, from, least](const ContactSegment& side) {
                return !(separation(side, from) > (side.is_inner ? Real(0) : least));
            };
        };
        return all_of(s.first, is_no_better(other)) && all_of(other, is_no_better(s.first));
    }

  private:
    const ContactRoom<D, Real>& room_;
    const SweepState<D, Real>& state_;

    Vector corner(const ContactSegment& s) const { return state_.position_at(state_.slot_of[s.a]); }
    Vector end(const ContactSegment& s) const { return state_.position_at(state_.slot_of[s.b]); }
    /// Distance of a point beyond a side; negative inside.
    Real beyond(const ContactSegment& s, const Vector& x) const {
        return dot(left_of(corner(s), end(s)) * Real(s.side), x - corner(s));
    }
    template <class Test> bool all_of(std::uint32_t solid, const Test& test) const {
        const auto first = room_.segments.begin() + std::ptrdiff_t(solid);
        return std::all_of(first, first + std::ptrdiff_t(first->count), test);
    }
    /// Distance of the deepest corner of a solid beyond a side of another.
    Real separation(const ContactSegment& s, std::uint32_t solid) const {
        Real least = std::numeric_limits<Real>::infinity();
        all_of(solid, [&](const ContactSegment& other) {
            least = min(least, beyond(s, corner(other)));
            return true;
        });
        return least;
    }
    /// True for a closed outline that turns one way at each corner.
    bool is_convex(std::uint32_t solid) const {
        const auto* const segments = room_.segments.data() + solid;
        const auto count = segments->count;
        for (std::uint32_t i = 0; i < count; ++i) {
            const auto &s = segments[i], &next = segments[(i + 1) % count];
            if (s.b != next.a || s.side == 0 || beyond(s, end(next)) > Real(0)) return false;
        }
        return count > 2;
    }
};

} // namespace sinew::detail

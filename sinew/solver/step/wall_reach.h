#pragma once

#include "sinew/collide/collider.h"
#include "sinew/solver/contact/behind_walls.h"

#include <algorithm>
#include <span>

namespace sinew::detail {

/// Walls that a body may touch within a step.
template <int D, class Real> class WallReach {
  public:
    using BoxT = collide::BoundingBox<D, Real>;
    struct Margins {
        Real fall = 0;          ///< in a step, m
        Real link = 0;          ///< half of the longest link, m: links are capsules
        bool is_pulled = false; ///< by a pin, as far as the box reaches
    };

    /// `box`: around what the body passes over.
    WallReach(const World<D, Real>& world, std::span<const Row> rows, const BoxT& box, Real dt)
        : world_(world), p_(world.particles), rows_(rows), box_(box), dt_(dt) {}

    bool any(const Margins& margins) const {
        return std::ranges::any_of(world_.bounds, [&](const auto& plane) { return reaches(plane); }) ||
               std::ranges::any_of(world_.colliders, [&](const auto& collider) { return reaches(collider, margins); });
    }

  private:
    const World<D, Real>& world_;
    const Particles<D, Real>& p_;
    std::span<const Row> rows_;
    const BoxT& box_;
    Real dt_;

    bool reaches(const HalfSpace<D, Real>& plane) const {
        const auto deepest =
            Vec<D, Real>::map([&](int k) { return plane.normal[k] > Real(0) ? box_.low[k] : box_.high[k]; });
        return dot(plane.normal, deepest) <= plane.offset;
    }
    bool reaches(const collide::Collider<D, Real>& collider, const Margins& margins) const {
        const auto bounds = collide::bounds_in_step(collider);
        if (!bounds.overlaps(box_)) return false;
        if (margins.is_pulled) return true;
        return std::ranges::any_of(rows_, [&](Row row) {
            if (!touch(filter_of(world_, row), collider.filter)) return false;
            const Real way = norm(p_.velocity[row]) * dt_;
            const Real within = Real(1.5) * (way + p_.radius[row]) + margins.fall + margins.link;
            BoxT box;
            box.include(p_.position[row]);
            if (!bounds.overlaps(box.grown(within))) return false;
            return !collider.is_at_rest() ||
                   collide::nearest(collider.shape, collider.target, p_.position[row], within);
        });
    }
};

} // namespace sinew::detail

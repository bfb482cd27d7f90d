#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <algorithm>

/// Room around a chain: an axis-parallel box that no plane or collider reaches. Within, the chain meets nothing.
namespace sinew::detail {

template <int D, class Real> class ChainRoom {
  public:
    using Box = collide::BoundingBox<D, double>;

    ChainRoom(const World<D, Real>& world, const Solver<D, Real>& solver)
        : world_(world), colliders_(solver.touches.boxes) {}

    /// The room of a chain, held at a place, of the given length and thickness; `reached` is as far as the nodes come
    /// in a step, radii included. Empty if something may be touched.
    Box find(const Vec<D, double>& held, double length, const Box& reached) const {
        Box all;
        all.include(held);
        return is_clear(all.grown(length)) ? Box::everything() : find(reached);
    }
    /// Same for a free block.
    Box find(const Box& reached) const { return is_clear(reached) ? reached : Box{}; }

  private:
    const World<D, Real>& world_;
    const std::vector<collide::BoundingBox<D, Real>>& colliders_;

    bool is_clear(const Box& box) const {
        return std::none_of(world_.bounds.begin(), world_.bounds.end(),
                            [&](const auto& plane) { return depth(plane, box) >= 0; }) &&
               std::none_of(colliders_.begin(), colliders_.end(), [&](const auto& collider) {
                   return Box{cast<double>(collider.low), cast<double>(collider.high)}.overlaps(box);
               });
    }
    /// Depth of the deepest corner of a box beyond a plane, m.
    static double depth(const HalfSpace<D, Real>& plane, const Box& box) {
        double deepest = double(plane.offset);
        for (int k = 0; k < D; ++k) {
            const double normal = double(plane.normal[k]);
            deepest -= min(normal * box.low[k], normal * box.high[k]);
        }
        return deepest;
    }
};

} // namespace sinew::detail

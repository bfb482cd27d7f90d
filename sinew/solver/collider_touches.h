#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/world/contacts.h"

#include <vector>

namespace sinew {

/// Touches of particles and colliders during a step. Each particle reports one collider: the one that pressed hardest.
/// Planes count on from the colliders, where they are listed.
template <int D, class Real> struct ColliderTouches {
    std::vector<collide::BoundingBox<D, Real>> boxes; ///< of the colliders during the step
    std::vector<std::uint32_t> collider;              ///< by particle: 1 + index of the collider, or 0
    std::vector<Real> impulse;                        ///< by particle: of that collider, newton seconds
    std::vector<ColliderTouch> before;                ///< pairs of the step before, in order
    std::vector<FigureTouch> figures;                 ///< of the step, in any order, some of them several times
    std::vector<FigureTouch> figures_before;          ///< of the step before, in order

    void set(Row row, std::uint32_t index, Real of) { collider[row] = index + 1, impulse[row] = of; }

    /// Adds the impulse of a collider on a particle: the last that pressed harder than all before counts.
    void add(Row row, std::uint32_t index, Real of) {
        const bool is_same = collider[row] == index + 1;
        if (!is_same && collider[row] != 0 && of <= impulse[row]) return;
        set(row, index, of + (is_same ? impulse[row] : Real(0)));
    }
};

} // namespace sinew

#pragma once

#include "sinew/solver/cloth/thin_room.h"
#include "sinew/solver/sweep_state.h"
#include "sinew/world/world.h"

/// Contact of thin cloth with itself and with other cloth (thin_contact.cpp): vertices and faces, edges and edges.
namespace sinew::detail {

/// A substep, counted from 1.
template <class Real> struct SubstepSpan {
    Real h = 0; ///< time units
    int number = 1, count = 1;
};

/// Parts layers of thin cloth nearer than their thickness, after an iteration over the links.
template <int D, class Real>
void part_thin_cloth(const World<D, Real>& world, SweepState<D, Real>& state, ThinRoom<D, Real>& room,
                     const SubstepSpan<Real>& span);
/// Truncates displacements at the planes that part the features of thin cloth, before positions advance: cloth without
/// crossings stays so (cf. Offset Geometric Contact, Chen et al. 2025).
template <int D, class Real>
void truncate_thin_cloth(const World<D, Real>& world, SweepState<D, Real>& state, ThinRoom<D, Real>& room,
                         const SubstepSpan<Real>& span);

} // namespace sinew::detail

#pragma once

#include "sinew/solver/contact/figure_rows.h"
#include "sinew/solver/contact/solid_wall_rows.h"

namespace sinew::detail {

/// Makes the rows of contact of a part at the start of a substep. `from`, `to`: shares of the step at the ends of the
/// substep.
template <int D, class Real>
void build_rows(World<D, Real>& world, Solver<D, Real>& solver, ContactPart<D, Real>& part, Real h, Real from,
                Real to) {
    part.rows.clear(), part.origins.clear(), part.wall_keys.clear(), part.deep.clear(), part.held.clear();
    part.sensed.clear(), part.sensed_origins.clear();
    FigureRows<D, Real>(world, solver, part, h).add_all(kernels<D, Real>(solver.options.simd));
    part.first_wall = part.rows.size();
    WallRows<D, Real>(world, solver, part, h, from, to).add_all();
    if constexpr (D == 3) SolidWallRows<Real>(world, solver, part, h, from, to).add_all();
}

} // namespace sinew::detail

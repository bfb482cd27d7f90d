#pragma once

#include "sinew/solver/sweep/substep.h"

#include <span>

namespace sinew::detail {

/// The substeps of one step over all that is swept.
template <int D, class Real> class Substeps {
  public:
    const int count;
    const Real h; ///< length of a substep, time units

    Substeps(World<D, Real>& world, Solver<D, Real>& solver, int substeps, Real substep)
        : count(substeps), h(substep), world_(world), solver_(solver),
          kernels_(sinew::kernels<D, Real>(solver.options.simd)),
          links_(solver.sweep_state.link_columns(
              std::get<kind_number<Distance, D>>(world.constraints).multiplier.data())) {}

    const Kernels<D, Real>& kernels() const { return kernels_; }
    /// Substep 1 to count.
    Substep<D, Real> number(int number) const {
        return Substep<D, Real>(world_, solver_, kernels_, links_, number, count, h);
    }

    /// Factor of velocities by the common damping over all substeps.
    double decay() const {
        const double later = double(number(2).keep());
        double keep = double(number(1).keep());
        for (int i = 2; i <= count; ++i) keep *= later;
        return keep;
    }

    std::span<const Tile> tiles_of(const Component& component) const {
        return std::span(solver_.sweep_state.plan.tiles).subspan(component.first_tile, component.tiles);
    }

  private:
    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    const Kernels<D, Real>& kernels_;
    DistanceColumns<D, Real> links_;
};

} // namespace sinew::detail

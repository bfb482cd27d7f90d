#pragma once

#include "sinew/math/vec.h"

#include <vector>

namespace sinew {

/// Energy budget of a figure: a bound on the kinetic energy after the constraints of a substep
/// (sweep/energy_budgets.cpp).
template <int D> struct Budget {
    bool passive = false; ///< has angle limits, no compliant or driven constraint, and no constraint to other figures
    bool struck = false;  ///< an angle is at a limit
    bool held = false;    ///< held in place: momentum is not conserved
    double before = 0, after = 0, mass = 0, keep = 1;
    Vec<D, double> momentum{}, drift{};
};

template <int D, class Real> struct Budgets {
    std::vector<Budget<D>> figures;    ///< by figure; recomputed in each step with a passive figure
    std::vector<Vec<D, Real>> carried; ///< per pin of the plan: velocity of the particle before the constraints
    bool any = false;                  ///< some figure is passive
};

} // namespace sinew

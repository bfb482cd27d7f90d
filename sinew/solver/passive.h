#pragma once

#include "sinew/math/vec.h"

#include <vector>

namespace sinew {

/// What the constraints of a figure may do to its kinetic energy during a substep (passive.cpp).
template <int D> struct Budget {
    bool passive = false; ///< it has turns to limit, stores nothing, and reaches no further than itself
    bool struck = false;  ///< one of its turns is at its limit
    bool held = false;    ///< something holds it in place: its momentum is not its own
    double before = 0, after = 0, mass = 0, keep = 1;
    Vec<D, double> momentum{}, drift{};
};

template <int D> struct Budgets {
    std::vector<Budget<D>> figures; ///< room for a step where any is passive; all of it is found anew in each
    bool any = false;               ///< is passive
};

} // namespace sinew

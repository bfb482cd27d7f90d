#pragma once

#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

namespace sinew {

/// A world, and a solver that moves it. A copy moves on alike, to the last bit.
template <int D, class Real = double> struct Simulation {
    World<D, Real> world;
    Solver<D, Real> solver;

    /// Advances the world by dt: Solver::step.
    void step(Real dt) { solver.step(world, dt); }
};

} // namespace sinew

#pragma once

#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

#include <utility>

namespace sinew::test {

/// A world that brings its solver along: short for tests that step many worlds. A copy has a solver of its own.
template <int D, class RealT> struct Stepped : World<D, RealT> {
    Solver<D, RealT> solver;

    Stepped() = default;
    Stepped(World<D, RealT> world) : World<D, RealT>(std::move(world)) {}
};

template <int D, class Real> void step(Stepped<D, Real>& world, std::type_identity_t<Real> dt) {
    world.solver.step(world, dt);
}
template <int D, class Real> void prepare(Stepped<D, Real>& world) {
    world.solver.prepare(world);
}

} // namespace sinew::test

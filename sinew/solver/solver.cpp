#include "sinew/solver/solver.h"

#include "sinew/world/world.h"

namespace sinew {

template <int D, class Real> Solver<D, Real>::Solver() = default;
template <int D, class Real> Solver<D, Real>::Solver(const SolverOptions& chosen) : options(chosen) {}
template <int D, class Real> Solver<D, Real>::Solver(const Solver& other) : options(other.options) {}
template <int D, class Real> Solver<D, Real>& Solver<D, Real>::operator=(const Solver& other) {
    if (this != &other) *this = Solver(other.options);
    return *this;
}
template <int D, class Real> Solver<D, Real>::Solver(Solver&&) noexcept = default;
template <int D, class Real> Solver<D, Real>& Solver<D, Real>::operator=(Solver&&) noexcept = default;
template <int D, class Real> Solver<D, Real>::~Solver() = default;

template <int D, class Real> void Solver<D, Real>::follow(World<D, Real>& world) {
    if (identity && world.journal.reader == identity) return;
    Solver anew(options);
    anew.reports = std::move(reports);
    anew.identity = world.journal.reader = std::make_shared<const char>();
    *this = std::move(anew);
    world.journal.change_all();
}

#define SINEW_SOLVER(D, Real) template struct Solver<D, Real>;
SINEW_INSTANTIATE(SINEW_SOLVER)

} // namespace sinew

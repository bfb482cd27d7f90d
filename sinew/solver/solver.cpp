#include "sinew/solver/solver.h"

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

#define SINEW_SOLVER(D, Real) template struct Solver<D, Real>;
SINEW_INSTANTIATE(SINEW_SOLVER)

} // namespace sinew

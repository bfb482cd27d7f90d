#pragma once

#include "sinew/solver/simd/body_moments.h"
#include "sinew/solver/simd/distance.h"
#include "sinew/solver/simd/integrate.h"
#include "sinew/solver/simd/range_check.h"
#include "sinew/solver/simd/transpose.h"

/// All kernels. An including file is compiled for one instruction set.
namespace sinew {
namespace {

template <int D, class Real>
inline constexpr Kernels<D, Real> kernels_here{.project = project_runs<D, Real>,
                                               .tether = tether_all<D, Real>,
                                               .advance = move_all<D, Real, Doing{.advances = true}>,
                                               .drift = move_all<D, Real, Doing{.drifts = true}>,
                                               .go_on = move_all<D, Real, Doing{true, true}>,
                                               .lowest = lowest_of<D, Real>,
                                               .moments = moments_of<D, Real>,
                                               .turn = turn_body<D, Real>,
                                               .to_columns = to_columns<D, Real>,
                                               .to_rows = to_rows<D, Real>,
                                               .all_within = all_within<true, Real>,
                                               .all_within_and_positive = all_within<false, Real>};

} // namespace
} // namespace sinew

/// Defines the kernels of this file as `name`.
#define SINEW_KERNELS(name)                                                                                            \
    namespace sinew {                                                                                                  \
    extern const KernelSet name;                                                                                       \
    const KernelSet name{kernels_here<2, float>, kernels_here<2, double>, kernels_here<3, float>,                      \
                         kernels_here<3, double>};                                                                     \
    }

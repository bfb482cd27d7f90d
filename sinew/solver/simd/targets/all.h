#pragma once

#include "sinew/solver/simd/body_moments.h"
#include "sinew/solver/simd/chain.h"
#include "sinew/solver/simd/distance.h"
#include "sinew/solver/simd/integrate.h"
#include "sinew/solver/simd/link_projection.h"
#include "sinew/solver/simd/near_pairs.h"
#include "sinew/solver/simd/node_exchange.h"
#include "sinew/solver/simd/program.h"
#include "sinew/solver/simd/range_check.h"
#include "sinew/solver/simd/transpose.h"

#include <type_traits>

/// All kernels. An including file is compiled for one instruction set.
namespace sinew {
namespace {

template <int D, class Real> constexpr Kernels<D, Real> kernels_here(std::type_identity<Kernels<D, Real>>) {
    return {.project = project_runs<D, Real>,
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
            .all_within_and_positive = all_within<false, Real>,
            .load_nodes = load_nodes<D, Real>,
            .store_nodes = store_nodes<D, Real>,
            .block_lanes = lane::widest<double>,
            .swing_chains = swing_chains<D, lane::widest<double>>,
            .swing_chain = swing_chains<D, min_block_lanes>,
            .swing_programs = swing_programs<D, lane::widest<double>>,
            .swing_program = swing_programs<D, min_block_lanes>,
            .links = link_kernels<D, Real>(),
            .near_pairs = near_pairs<D, Real>};
}

template <class... Each> constexpr AllKernels<Each...> all_kernels_here(std::type_identity<AllKernels<Each...>>) {
    return {kernels_here(std::type_identity<Each>{})...};
}

} // namespace
} // namespace sinew

/// Defines the kernels of this file as `name`.
#define SINEW_KERNELS(name)                                                                                            \
    namespace sinew {                                                                                                  \
    extern const KernelSet name;                                                                                       \
    constinit const KernelSet name = all_kernels_here(std::type_identity<KernelSet>{});                                \
    }

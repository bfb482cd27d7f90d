#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/simd/inverse_length.h"
#include "sinew/solver/simd/kernel.h"

/// Kernels of particles moving independently of each other.
namespace sinew {
namespace {

using namespace lane;

/// Calls f(at, count), with the pack V and whether all lanes count, for slots [first, last).
template <class Real, class F> [[gnu::always_inline]] inline void over(std::size_t first, std::size_t last, F&& f) {
    constexpr int width = widest<Real>;
    using V = Pack<Real, width>;
    for (; first + width <= last; first += width) f.template operator()<V, true>(first, width);
    if (first < last) f.template operator()<V, false>(first, int(last - first));
}

/// Columns of the components.
template <int D, class Real> struct Components {
    Real* column[D];
    Components(Real* first, std::size_t stride) {
        for (unsigned k = 0; k < D; ++k) column[k] = first + k * stride;
    }
    Real* operator[](unsigned k) const { return column[k]; }
};

/// Outer loop over anchors: so no particle waits for the anchor before.
template <int D, class Real> void tether_all(const Motion<D, Real>& columns, std::uint32_t first, std::uint32_t last) {
    const Motion<D, Real> motion = columns;
    const Components<D, Real> position(motion.position, motion.stride), moves(motion.displacement, motion.stride);
    for (std::uint32_t i = 0; i < motion.anchor_count; ++i) {
        const auto anchor = motion.anchors[i];
        over<Real>(
            first, last, [&]<class V, bool all>(std::size_t at, int count) __attribute__((always_inline)) {
                V displacement[D], e[D], e2{};
                const V zero{};
#pragma GCC unroll 3
                for (unsigned k = 0; k < D; ++k) {
                    displacement[k] = load<V>(moves[k] + at);
                    e[k] = (load<V>(position[k] + at) + anchor.opposite[k]) + displacement[k];
                    e2 = k ? e2 + e[k] * e[k] : e[k] * e[k];
                }
                const V per = load<V>(anchor.half_per_max_length_square + at);
                const V half = e2 * (load<V>(motion.mobility + at) > zero ? per : zero);
                const V back = lacking(
                    min(spread<V>(Real(0.5)) - half, zero),
                    Real(1), [&]() __attribute__((always_inline)) { return half + half; });
#pragma GCC unroll 3
                for (unsigned k = 0; k < D; ++k) put<all>(moves[k] + at, displacement[k] + e[k] * back, count);
            });
    }
}

/// Phases, in this order. Positions and displacements are clamped only in the last phase: the substeps of one step add
/// too little to clamped values to overflow.
struct Doing {
    bool advances = false, drifts = false;
};

template <int D, class Real, Doing doing>
void move_all(const Motion<D, Real>& columns, std::uint32_t first, std::uint32_t last) {
    const Motion<D, Real> motion = columns;
    const Components<D, Real> position(motion.position, motion.stride), moves(motion.displacement, motion.stride),
        residual(motion.residual, motion.stride);
    over<Real>(
        first, last, [&]<class V, bool all>(std::size_t at, int count) __attribute__((always_inline)) {
            const V mobility = load<V>(motion.mobility + at);
#pragma GCC unroll 3
            for (unsigned k = 0; k < D; ++k) {
                const V displacement = load<V>(moves[k] + at);
                if constexpr (doing.advances) {
                    const V from = load<V>(position[k] + at), total = displacement + load<V>(residual[k] + at),
                            to = from + total;
                    put<all>(position[k] + at, doing.drifts ? to : within(to, spread<V>(motion.furthest)), count);
                    put<all>(residual[k] + at, total - (to - from), count);
                }
                if constexpr (!doing.drifts)
                    put<all>(moves[k] + at, within(displacement, spread<V>(motion.max)), count);
                if constexpr (doing.drifts) {
                    const V moved = displacement * motion.keep + motion.add[k];
                    const V held = doing.advances ? moved : within(moved, spread<V>(motion.max));
                    put<all>(moves[k] + at, mobility > V{} ? held : V{}, count);
                }
            }
        });
}

template <int D, class Real>
Real lowest_of(const Motion<D, Real>& all, const Real* normal, std::uint32_t first, std::uint32_t last) {
    Real found = Real(3e38);
    over<Real>(
        first, last, [&]<class V, bool whole>(std::size_t at, int count) __attribute__((always_inline)) {
            V height{};
            for (unsigned k = 0; k < D; ++k)
                height = height + (load<V>(all.position + k * all.stride + at) +
                                   load<V>(all.displacement + k * all.stride + at)) *
                                      normal[k];
            for (int k = 0; k < count; ++k) found = min(found, lane_of(height, k));
        });
    return found;
}

} // namespace
} // namespace sinew

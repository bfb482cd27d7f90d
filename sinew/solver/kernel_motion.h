#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/kernel.h"
#include "sinew/solver/kernel_length.h"

/// The text of the kernels that move particles one by one.
namespace sinew {
namespace {

using namespace lane;

/// Calls f(at, count) with V and whether all lanes count, for slots [first, last).
template <class Real, class F> [[gnu::always_inline]] inline void over(std::uint32_t first, std::uint32_t last, F&& f) {
    constexpr int width = widest<Real>;
    using V = Pack<Real, width>;
    for (; first + width <= last; first += width) f.template operator()<V, true>(first, width);
    if (first < last) f.template operator()<V, false>(first, int(last - first));
}

/// What is done, in this order.
struct Doing {
    bool tethers = false, advances = false, drifts = false;
};

/// A pack of particles.
template <int D, class V> struct Moved {
    V place[D], move[D], residual[D];
    V mobility;

    template <class Real> [[gnu::always_inline]] void tether(const Anchor<D, Real>& anchor, std::uint32_t at) {
        V e[D], e2{}, zero{};
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            e[k] = (place[k] - anchor.place[k]) + move[k];
            e2 = k ? e2 + e[k] * e[k] : e[k] * e[k];
        }
        const V t = most(e2 * load<V>(anchor.per_reach_square + at), spread<V>(Real(1)));
        if (!any(t > spread<V>(Real(1)))) return;
        const V back = mobility > zero ? lacking(t) : zero;
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) move[k] = back < zero ? move[k] + e[k] * back : move[k];
    }

    template <class Real> [[gnu::always_inline]] void advance(const Motion<D, Real>& motion) {
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            const V from = place[k], total = move[k] + residual[k], to = from + total;
            place[k] = within(to, spread<V>(motion.furthest));
            residual[k] = total - (to - from);
        }
    }

    template <class Real> [[gnu::always_inline]] void drift(const Motion<D, Real>& motion) {
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            const V moved = within(move[k] * motion.keep + motion.add[k], spread<V>(motion.most));
            move[k] = mobility > V{} ? moved : V{};
        }
    }
};

template <int D, class Real, Doing doing>
void move_all(const Motion<D, Real>& columns, std::uint32_t first, std::uint32_t last) {
    const Motion<D, Real> motion = columns;
    over<Real>(
        first, last, [&]<class V, bool all>(std::uint32_t at, int count) __attribute__((always_inline)) {
            Moved<D, V> moved;
#pragma GCC unroll 3
            for (unsigned k = 0; k < D; ++k) {
                moved.move[k] = load<V>(motion.move + k * motion.apart + at);
                if constexpr (doing.tethers || doing.advances)
                    moved.place[k] = load<V>(motion.place + k * motion.apart + at);
                if constexpr (doing.advances) moved.residual[k] = load<V>(motion.residual + k * motion.apart + at);
            }
            moved.mobility = load<V>(motion.mobility + at);
            if constexpr (doing.tethers)
                for (std::uint32_t i = 0; i < motion.anchor_count; ++i) moved.tether(motion.anchors[i], at);
            if constexpr (doing.advances) moved.advance(motion);
            if constexpr (doing.drifts) moved.drift(motion);
#pragma GCC unroll 3
            for (unsigned k = 0; k < D; ++k) {
                put<all>(motion.move + k * motion.apart + at, moved.move[k], count);
                if constexpr (doing.advances) put<all>(motion.place + k * motion.apart + at, moved.place[k], count);
                if constexpr (doing.advances)
                    put<all>(motion.residual + k * motion.apart + at, moved.residual[k], count);
            }
        });
}

template <int D, class Real>
Real lowest_of(const Motion<D, Real>& all, const Real* normal, std::uint32_t first, std::uint32_t last) {
    Real found = Real(3e38);
    over<Real>(
        first, last, [&]<class V, bool whole>(std::uint32_t at, int count) __attribute__((always_inline)) {
            V height{};
            for (unsigned k = 0; k < D; ++k)
                height = height +
                         (load<V>(all.place + k * all.apart + at) + load<V>(all.move + k * all.apart + at)) * normal[k];
            for (int k = 0; k < count; ++k) found = least(found, lane_of(height, k));
        });
    return found;
}

} // namespace
} // namespace sinew

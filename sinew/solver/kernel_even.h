#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/kernel.h"
#include "sinew/solver/kernel_length.h"

/// The text of the kernel for most links of a cloth or a rope: rigid, and between particles that move equally readily.
/// Each takes half of the correction, so neither mobility nor multiplier is needed.
namespace sinew {
namespace {

using namespace lane;

/// The most a link may pull with, as everywhere (limit::multiplier): what hardly moves would take more than there is.
template <class Real> inline constexpr Real strongest = Real(1e25);

/// Lengths that links are held between, as a quarter of 1 / length^2.
template <class V> struct Wanted { V low, high; };

/// Those that swing are corrected along the link as it was when the substep began (kernel_links.h), the rest along the
/// link as it is.
template <int D, class Real, bool exact, bool kept, bool swings> struct EvenLinks {
    const LinkColumns<D, Real>& columns;
    const LinkRun& run;
    LinkPass<Real>& pass;
    const Real* place[D];
    Real* move[D];

    EvenLinks(const LinkColumns<D, Real>& from, LinkPass<Real>& in, const LinkRun& of)
        : columns(from), run(of), pass(in) {
        for (unsigned k = 0; k < D; ++k) place[k] = from.place + k * from.apart, move[k] = from.move + k * from.apart;
    }

    /// The links from number i on.
    template <class V, bool all>
    [[gnu::always_inline]] void project(std::size_t i, int count, const Wanted<V>& wanted) const {
        const std::size_t at_a = run.a + i, at_b = run.b + i;
        V a[D], b[D], d[D], e[D], e2{};
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            a[k] = load<V>(move[k] + at_a);
            b[k] = load<V>(move[k] + at_b);
            d[k] = load<V>(place[k] + at_b) - load<V>(place[k] + at_a);
            e[k] = d[k] + (b[k] - a[k]);
            e2 = k ? e2 + e[k] * e[k] : e[k] * e[k];
        }
        V half;
        if constexpr (swings)
            half = half_along<V, all>(d, e, e2, count, wanted);
        else
            half = half_lacking<V, all>(e2, count, wanted);
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            const V share = (swings ? d[k] : e[k]) * half;
            put<all>(move[k] + at_a, a[k] - share, count);
            put<all>(move[k] + at_b, b[k] + share, count);
        }
        if constexpr (kept) {
            const V length = root(e2), along = swings ? root(dot(d, d)) : length;
            const V lambda = within(along * half / load<V>(columns.mobility + at_a), spread<V>(strongest<Real>));
            note<V, all>(i, count, lambda, wanted.low < spread<V>(Real(1e29)) ? length : spread<V>(Real(1)));
        }
    }

    /// Half of what they lack: each end takes that.
    template <class V, bool all>
    [[gnu::always_inline]] V half_lacking(const V& square, int count, const Wanted<V>& wanted) const {
        const V quarter = spread<V>(Real(0.25)), zero{};
        V half = quarter - square * wanted.low;
        if constexpr (!exact) half = most(half, zero) + least(quarter - square * wanted.high, zero);
        if constexpr (!all) half = first_lanes(half, count, Real(0));
        return lacking(
            half, Real(0.5), [&]() __attribute__((always_inline)) {
                if (any(half < spread<V>(Real(0.25) * (1 - strained<Real>)))) pass.strained = true;
                if constexpr (exact) return square * wanted.low * Real(4);
                return square * (half < zero ? wanted.high : wanted.low) * Real(4);
            });
    }

    /// The part of d, the link as it was, that each end takes; e is the link as it is. With t = e^2 / L^2 and
    /// u = d e / L^2 that is (1/sqrt(t) - 1)/2 t/u, near t = u = 1 about (1 - t)/4 (2 - u). Where the link has turned
    /// by more than 8 degrees or is twice as long as it should be, d becomes e.
    template <class V, bool all>
    [[gnu::always_inline]] V half_along(V (&d)[D], const V (&e)[D], const V& e2, int count,
                                        const Wanted<V>& wanted) const {
        const V quarter = spread<V>(Real(0.25)), zero{}, d_e = dot(d, e);
        V half = quarter - e2 * wanted.low, turned = quarter - d_e * wanted.low;
        if constexpr (!all) half = first_lanes(half, count, Real(0)), turned = first_lanes(turned, count, Real(0));
        const V nearly = half * (turned * Real(4) + Real(1));
        const V near = spread<V>(Real(1.0 / 128)), away = most(half * half, turned * turned);
        if (any_less(near * near, away)) [[unlikely]] {
            if (any(half < spread<V>(Real(0.25) * (1 - strained<Real>)))) pass.strained = true;
            const V t = e2 * wanted.low * Real(4), one = spread<V>(Real(1));
            V along = turned * turned < spread<V>(Real(1.0 / 64)) ? d_e : zero; // u from 1/2 to 3/2
            along = t < spread<V>(Real(4)) ? along : zero;
            const auto agree = along * along > Real(0.99 * 0.99) * (e2 * dot(d, d));
            const V lack = Real(0.5) / root(most(t, spread<V>(Real(1e-30)))) - Real(0.5);
            const V part = lack * ((agree ? e2 : one) / (agree ? along : one));
            for (unsigned k = 0; k < D; ++k) d[k] = near * near < away ? (agree ? d[k] : e[k]) : d[k];
            return near * near < away ? part : nearly;
        }
        return nearly;
    }

    template <class V> [[gnu::always_inline]] static V dot(const V (&a)[D], const V (&b)[D]) {
        V sum = a[0] * b[0];
#pragma GCC unroll 3
        for (unsigned k = 1; k < D; ++k) sum = sum + a[k] * b[k];
        return sum;
    }

    template <class V, bool all>
    [[gnu::always_inline]] void note(std::size_t i, int count, const V& lambda, const V& length) const {
        if (any(length < spread<V>(Real(1e-18)))) [[unlikely]]
            for (int k = 0; k < count; ++k) pass.shortest = least(pass.shortest, lane_of(length, k));
        if (run.row_step == 0) {
            for (int k = 0; k < count; ++k)
                columns.multiplier[columns.rows[run.row + i + std::size_t(k)]] = lane_of(lambda, k);
            return;
        }
        Real* const to = columns.multiplier + run.row + i * run.row_step;
        if (run.row_step == 1) return put<all>(to, lambda, count);
        put_apart(to, lambda, count, run.row_step);
    }

    /// Those of a run.
    [[gnu::always_inline]] void solve() const {
        constexpr int width = widest<Real>;
        using V = Pack<Real, width>;
        const std::size_t end = run.count;
        std::size_t i = 0;
        if (run.uniform) {
            const auto same = wanted<V>(
                run.parameters, [](const Real* from) __attribute__((always_inline)) { return spread<V>(*from); });
            for (; i + width <= end; i += width) project<V, true>(i, width, same);
            if (i < end) project<V, false>(i, int(end - i), same);
            return;
        }
        const auto own = [&](std::size_t k) __attribute__((always_inline)) {
            return wanted<V>(
                run.parameters + k, [](const Real* from) __attribute__((always_inline)) { return load<V>(from); });
        };
        for (; i + width <= end; i += width) project<V, true>(i, width, own(i));
        if (i < end) project<V, false>(i, int(end - i), own(i));
    }

    template <class V, class Get> [[gnu::always_inline]] Wanted<V> wanted(std::size_t at, Get&& get) const {
        Wanted<V> wanted{get(columns.per_square + at) * Real(0.25), V{}};
        if constexpr (!exact) {
            const V high = get(columns.high + at);
            wanted.high = Real(0.25) / (high * high);
        }
        return wanted;
    }
};

} // namespace
} // namespace sinew

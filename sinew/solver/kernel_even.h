#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/kernel.h"
#include "sinew/solver/kernel_length.h"

/// The text of the kernel for most links of a cloth: rigid, corrected as they are now, and between particles that move
/// equally readily. Each takes half of the correction, so neither mobility nor multiplier is needed.
namespace sinew {
namespace {

using namespace lane;

/// The most a link may pull with, as everywhere (limit::multiplier): what hardly moves would take more than there is.
template <class Real> inline constexpr Real strongest = Real(1e25);

/// Lengths that links are held between.
template <class V> struct Wanted {
    V low, per_low_square, per_high_square;
    Wanted(const V& at_least, const V& at_most)
        : low(at_least), per_low_square(per_square(at_least)), per_high_square(per_square(at_most)) {}
    /// Just that length, of which 1 / length^2 is known.
    struct Exactly {
        V length, per_square;
    };
    Wanted(const Exactly& to) : low(to.length), per_low_square(to.per_square), per_high_square(to.per_square) {}
};

template <int D, class Real, bool exact, bool kept> struct EvenLinks {
    const Real *place_a, *place_b;
    Real *move_a, *move_b;
    std::size_t apart;
    const Real* mobility;
    const LinkColumns<D, Real>& columns;
    const LinkRun& run;
    LinkPass<Real>& pass;

    EvenLinks(const LinkColumns<D, Real>& from, LinkPass<Real>& in, const LinkRun& of)
        : place_a(from.place + of.a), place_b(from.place + of.b), move_a(from.move + of.a), move_b(from.move + of.b),
          apart(from.apart), mobility(from.mobility + of.a), columns(from), run(of), pass(in) {}

    template <class V, bool all>
    [[gnu::always_inline]] void project(std::uint32_t i, int count, const Wanted<V>& wanted) const {
        V a[D], b[D], e[D], e2{};
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            a[k] = load<V>(move_a + i + k * apart);
            b[k] = load<V>(move_b + i + k * apart);
            e[k] = (load<V>(place_b + i + k * apart) - load<V>(place_a + i + k * apart)) + (b[k] - a[k]);
            e2 = k ? e2 + e[k] * e[k] : e[k] * e[k];
        }
        const V by = lacking_of<V, all>(e2, count, wanted), half = by * Real(0.5);
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            const V share = e[k] * half;
            put<all>(move_a + i + k * apart, a[k] - share, count);
            put<all>(move_b + i + k * apart, b[k] + share, count);
        }
        if constexpr (kept) {
            const V w = load<V>(mobility + i), length = root(e2);
            const V lambda = within(length * by / (w + w), spread<V>(strongest<Real>));
            note<V, all>(i, count, lambda, wanted.low > V{} ? length : spread<V>(Real(1)));
        }
    }

    template <class V, bool all>
    [[gnu::always_inline]] V lacking_of(const V& square, int count, const Wanted<V>& wanted) const {
        const auto part = [&](const V& per) __attribute__((always_inline)) {
            if constexpr (all)
                return square * per;
            else
                return first_lanes(square * per, count, Real(1));
        };
        const V one = spread<V>(Real(1)), t = part(wanted.per_low_square);
        if constexpr (exact) return lacking(t, pass.strained);
        return lacking(least(t, one)) + lacking(most(part(wanted.per_high_square), one), pass.strained);
    }

    template <class V, bool all>
    [[gnu::always_inline]] void note(std::uint32_t i, int count, const V& lambda, const V& length) const {
        if (any(length < spread<V>(Real(1e-18)))) [[unlikely]]
            for (int k = 0; k < count; ++k) pass.shortest = least(pass.shortest, lane_of(length, k));
        if (run.row_step == 0) {
            for (int k = 0; k < count; ++k)
                columns.multiplier[columns.rows[run.row + i + unsigned(k)]] = lane_of(lambda, k);
            return;
        }
        Real* const to = columns.multiplier + run.row + std::size_t(i) * run.row_step;
        if (run.row_step == 1) return put<all>(to, lambda, count);
        put_apart(to, lambda, count, run.row_step);
    }

    /// Each within its own limits, or all within those of the first.
    [[gnu::always_inline]] void solve(std::uint32_t count, const Real* low, const Real* high, bool uniform) const {
        constexpr int width = widest<Real>;
        using V = Pack<Real, width>;
        std::uint32_t i = 0;
        if (uniform) {
            const Wanted<V> same(spread<V>(*low), spread<V>(*high));
            for (; i + width <= count; i += width) project<V, true>(i, width, same);
            if (i < count) project<V, false>(i, int(count - i), same);
            return;
        }
        const auto own = [&](std::uint32_t k) __attribute__((always_inline)) {
            if constexpr (exact)
                return Wanted<V>(
                    typename Wanted<V>::Exactly{load<V>(low + k), load<V>(columns.per_square + run.parameters + k)});
            else
                return Wanted<V>(load<V>(low + k), load<V>(high + k));
        };
        for (; i + width <= count; i += width) project<V, true>(i, width, own(i));
        if (i < count) project<V, false>(i, int(count - i), own(i));
    }
};

} // namespace
} // namespace sinew

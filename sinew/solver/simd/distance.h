#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/simd/inverse_length.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/rigid_distance.h"

#include <type_traits>
#include <utility>

/// Kernel of distances: every kind of batch; batches of kind `other` by the general text, the rest by
/// simd/rigid_distance.h.
namespace sinew {
namespace {

using namespace lane;

/// Loads and stores of columns at consecutive or scattered slots. Only the first `count` lanes are stored.
struct SideBySide {
    std::uint32_t slot;
    template <class V, class Real> [[gnu::always_inline]] V get(const Real* column, int) const {
        return load<V>(column + slot);
    }
    template <bool all, class V, class Real>
    [[gnu::always_inline]] void put(Real* column, const V& pack, int count) const {
        lane::put<all>(column + slot, pack, count);
    }
};
struct Scattered {
    const std::uint32_t* slots;
    template <class V, class Real> [[gnu::always_inline]] V get(const Real* column, int count) const {
        if (count == int(sizeof(V) / sizeof(Real))) return gather<V>(column, slots);
        Real numbers[sizeof(V) / sizeof(Real)] = {};
        for (int i = 0; i < count; ++i) numbers[i] = column[slots[i]];
        return load<V>(numbers);
    }
    template <bool all, class V, class Real>
    [[gnu::always_inline]] void put(Real* column, const V& pack, int count) const {
        if constexpr (all) return scatter(column, slots, pack);
        Real numbers[sizeof(V) / sizeof(Real)];
        store(numbers, pack);
        for (int i = 0; i < count; ++i) column[slots[i]] = numbers[i];
    }
};

template <class V> struct Limits { V low, high, alpha; };

/// Variant of batches to compile a kernel for.
struct Rules {
    bool kept = true;         ///< multipliers are stored
    bool compliant = true;    ///< some links are compliant
    bool range = true;        ///< some links are inequalities
    bool old_gradient = true; ///< corrected along the link at the start of the substep, where possible
};

/// Distance held within [low, high] by the multiplier lambda (formulas in project.h). d is the direction of correction:
/// the link e, or with `old_gradient` the link at the start of the substep, unless turned by more than 8 degrees since.
///
///     s = (limit - length) / (|d| (w n . d/|d| + alpha)),   n = e / length
///     b moves by w_b s d, a by -w_a s d
template <int D, class Real, Rules rules, class Ends> struct Projection {
    const DistanceColumns<D, Real>& columns;
    DistancePass<Real>& pass;
    const LinkBatch& run;

    /// Links from a number on: ends with their displacements, link now, and direction of correction.
    template <class V> struct Link {
        Ends a, b;
        V displacement_a[D], displacement_b[D];
        V e[D], d[D];
        V e2{}, d2{}, d_e{};
    };

    /// Solves the links from number i on: a full pack with `all`, otherwise `count`.
    template <class V, bool all>
    [[gnu::always_inline]] void project(std::uint32_t i, int count, const Limits<V>& limits) const {
        const auto link = link_at<V>(i, count);
        if (!run.compliant) look_at<V, all>(link.e2, rules.range || rules.kept ? limits.high : limits.low, count);
        const V w_a = link.a.template get<V>(columns.mobility, count);
        const V w_b = link.b.template get<V>(columns.mobility, count);
        V resistance = (w_a + w_b) * link.d_e, length{}, d_length{}, zero{};
        if constexpr (rules.compliant || rules.kept) d_length = root(link.d2);
        if constexpr (rules.range || rules.kept) length = root(link.e2);
        if constexpr (rules.compliant) resistance = resistance + limits.alpha * (length * d_length);
        // zero length or mobility gives zero resistance: the products below are then zero
        constexpr Real min_resistance = sizeof(Real) == 4 ? Real(1e-26) : Real(1e-200);
        const V per = Real(1) / max(resistance, spread<V>(min_resistance));
        if constexpr (rules.kept) {
            const V gain = w_a + w_b > zero ? length * per * d_length : zero;
            const V s = store_lambda<V, all>(i, count, limits, length, d_length, gain);
            move<V, all>(link, s * w_a, s * w_b, count);
        } else {
            V s;
            if constexpr (rules.range)
                s = (max(limits.low - length, zero) + min(limits.high - length, zero)) * length;
            else
                s = lacking_of(limits.low, link.e2);
            move<V, all>(link, s * (per * w_a), s * (per * w_b), count);
        }
    }

    template <class V> [[gnu::always_inline]] Link<V> link_at(std::uint32_t i, int count) const {
        const auto [a, b] = ends(i);
        Link<V> link;
        link.a = a, link.b = b;
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            link.displacement_a[k] = a.template get<V>(columns.displacement + k * columns.stride, count);
            link.displacement_b[k] = b.template get<V>(columns.displacement + k * columns.stride, count);
            link.d[k] = b.template get<V>(columns.position + k * columns.stride, count) -
                        a.template get<V>(columns.position + k * columns.stride, count);
            link.e[k] = link.d[k] + (link.displacement_b[k] - link.displacement_a[k]);
            link.e2 = k ? link.e2 + link.e[k] * link.e[k] : link.e[k] * link.e[k];
        }
        choose_direction(link);
        return link;
    }

    /// The direction at the start of the substep, in `d`, is kept with `old_gradient` if it agrees with the link now.
    template <class V> [[gnu::always_inline]] void choose_direction(Link<V>& link) const {
        auto& [a, b, displacement_a, displacement_b, e, d, e2, d2, d_e] = link;
        if constexpr (rules.old_gradient) {
            const V zero{};
            d2 = d_e = zero;
#pragma GCC unroll 3
            for (unsigned k = 0; k < D; ++k) d2 = d2 + d[k] * d[k], d_e = d_e + d[k] * e[k];
            const Real agreement = run.old_gradient ? Real(min_agreement * min_agreement) : Real(2); // 2: never agree
            const auto agree = d_e * max(d_e, zero) > agreement * (e2 * d2);
            d2 = agree ? d2 : e2, d_e = agree ? d_e : e2;
#pragma GCC unroll 3
            for (unsigned k = 0; k < D; ++k) d[k] = agree ? d[k] : e[k];
        } else {
            d2 = d_e = e2;
#pragma GCC unroll 3
            for (unsigned k = 0; k < D; ++k) d[k] = e[k];
        }
    }

    /// Updates the multipliers by a `gain` for a unit of length. Returns the changes, relative to the direction.
    template <class V, bool all>
    [[gnu::always_inline]] V store_lambda(std::uint32_t i, int count, const Limits<V>& limits, const V& length,
                                          const V& d_length, const V& gain) const {
        const V zero{}, lambda = multipliers<V, all>(i, count);
        const V slack = rules.compliant ? limits.alpha * lambda : zero;
        const V pushing = lambda + (limits.low - length - slack) * gain;
        const V pulling = lambda + (limits.high - length - slack) * gain;
        V next = within(max(pushing, zero) + min(pulling, zero), spread<V>(limit::multiplier<Real>));
        if (pass.again) next = min(next, lambda); // repair only shortens
        note<V, all>(i, count, next, limits.low > zero ? length : spread<V>(Real(1)));
        const V divisor = d_length > zero ? d_length : spread<V>(Real(1)); // masked lanes are divided, too
        return d_length > zero ? (next - lambda) / divisor : zero;
    }

    /// (limit - length) length. Near the limit half of the difference of the squares is accurate and needs no root; not
    /// used for inequalities: the error would make the link bounce.
    template <class V> [[gnu::always_inline]] static V lacking_of(const V& limit, const V& e2) {
        const V lack = Real(0.5) * (limit * limit - e2), near = e2 * Real(1.0 / 64), size = max(lack, -lack);
        if (any_less(near, size)) [[unlikely]] {
            const V length = root(e2);
            return near < size ? (limit - length) * length : lack;
        }
        return lack;
    }

    template <class V, bool all>
    [[gnu::always_inline]] void look_at(const V& square, const V& longest, int count) const {
        const V meant = all ? square : first_lanes(square, count, Real(0));
        if (any(meant > longest * longest * pass.overstretched_from)) [[unlikely]]
            pass.overstretched = true;
    }

    template <class V, bool all>
    [[gnu::always_inline]] void move(const Link<V>& link, const V& s_a, const V& s_b, int count) const {
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            link.a.template put<all>(columns.displacement + k * columns.stride,
                                     link.displacement_a[k] - link.d[k] * s_a, count);
            link.b.template put<all>(columns.displacement + k * columns.stride,
                                     link.displacement_b[k] + link.d[k] * s_b, count);
        }
    }

    template <class V, bool all>
    [[gnu::always_inline]] void note(std::uint32_t i, int count, const V& lambda, const V& length) const {
        if (any(length < spread<V>(limit::shortest_link<Real>))) [[unlikely]]
            for (int k = 0; k < count; ++k) pass.shortest = min(pass.shortest, lane_of(length, k));
        if (run.row_step == 1) return lane::put<all>(columns.multiplier + run.row + i, lambda, count);
        std::uint32_t room[sizeof(V) / sizeof(Real)];
        rows(room, i).template put<all>(columns.multiplier, lambda, count);
    }

    [[gnu::always_inline]] std::pair<Ends, Ends> ends(std::uint32_t i) const {
        if constexpr (std::is_same_v<Ends, Scattered>)
            return {Ends{columns.ends_a + run.a + i}, Ends{columns.ends_b + run.a + i}};
        else
            return {Ends{run.a + i}, Ends{run.b + i}};
    }
    /// Rows of the links from number i on.
    template <std::size_t lanes>
    [[gnu::always_inline]] Scattered rows(std::uint32_t (&room)[lanes], std::uint32_t i) const {
        if (run.row_step == 0) return {columns.rows + run.row + i};
        for (std::uint32_t k = 0; k < lanes; ++k) room[k] = run.row + (i + k) * run.row_step;
        return {room};
    }
    template <class V, bool all> [[gnu::always_inline]] V multipliers(std::uint32_t i, int count) const {
        if (pass.first) return V{};
        if (all && run.row_step == 1) return load<V>(columns.multiplier + run.row + i);
        std::uint32_t room[sizeof(V) / sizeof(Real)];
        return rows(room, i).template get<V>(columns.multiplier, count);
    }

    template <class V, class Get> [[gnu::always_inline]] Limits<V> limits(std::uint32_t at, Get&& get) const {
        Limits<V> limits{get(columns.low + at), V{}, V{}};
        if constexpr (rules.range || rules.kept) limits.high = get(columns.high + at);
        if constexpr (rules.compliant)
            if (run.compliant)
                limits.alpha = min(spread<V>(limit::measure<Real>), get(columns.compliance + at) * pass.per_h2);
        return limits;
    }

    inline void all() const {
        constexpr int width = widest<Real>;
        using V = Pack<Real, width>;
        const auto same = limits<V>(
            run.parameters, [](const Real* from) __attribute__((always_inline)) { return spread<V>(*from); });
        const auto of = [&](std::uint32_t i) __attribute__((always_inline)) {
            if (run.uniform) return same;
            return limits<V>(
                run.parameters + i, [](const Real* from) __attribute__((always_inline)) { return load<V>(from); });
        };
        std::uint32_t i = 0;
        for (; i + width <= run.count; i += width) project<V, true>(i, width, of(i));
        if (i < run.count) project<V, false>(i, int(run.count - i), of(i));
    }
};

/// Solves a batch of any kind. Not inlined: needs more registers than the common kinds.
template <int D, class Real>
[[gnu::noinline]] void project_run(const DistanceColumns<D, Real>& columns, DistancePass<Real>& pass,
                                   const LinkBatch& run) {
    if (run.compliant && pass.again) return;
    constexpr Rules all{}, unyielding{true, false, false, false};
    constexpr Rules unkept{.kept = false}, simple{false, false, false, false}, rigid{false, false, true, true};
    if (run.scattered && pass.kept)
        Projection<D, Real, all, Scattered>{columns, pass, run}.all();
    else if (run.scattered && (run.compliant || !run.equality || run.old_gradient))
        Projection<D, Real, unkept, Scattered>{columns, pass, run}.all();
    else if (run.scattered)
        Projection<D, Real, simple, Scattered>{columns, pass, run}.all();
    else if (pass.kept && !run.compliant && !run.old_gradient)
        Projection<D, Real, unyielding, SideBySide>{columns, pass, run}.all();
    else if (pass.kept)
        Projection<D, Real, all, SideBySide>{columns, pass, run}.all();
    else if (run.compliant)
        Projection<D, Real, unkept, SideBySide>{columns, pass, run}.all();
    else
        Projection<D, Real, rigid, SideBySide>{columns, pass, run}.all();
}

template <int D, class Real>
void project_runs(const DistanceColumns<D, Real>& columns, DistancePass<Real>& pass, const LinkBatch* first,
                  const LinkBatch* last) {
    for (;; ++first) {
        first = project_kinds(columns, pass, first, last);
        if (first == last) return;
        project_run(columns, pass, *first);
    }
}

} // namespace
} // namespace sinew

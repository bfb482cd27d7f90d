#pragma once

#include "sinew/solver/simd/rigid_correction.h"

#include <array>
#include <limits>
#include <type_traits>

/// Fast path for most links: rigid, between consecutive slots. Multipliers are computed only on request, and mobilities
/// are not loaded where both ends move equally readily and take half of the correction each.
namespace sinew {
namespace {

using namespace lane;

template <int D, class Real, Rigid rules> struct RigidLinks {
    using V = Pack<Real, widest<Real>>;
    static constexpr std::size_t width = std::size_t(widest<Real>);

    const DistanceColumns<D, Real>& columns;
    DistancePass<Real>& pass;
    const LinkBatch& run;
    const Real *position_a, *position_b, *low, *high;
    Real *displacement_a, *displacement_b;
    std::size_t stride;

    RigidLinks(const DistanceColumns<D, Real>& from, DistancePass<Real>& in, const LinkBatch& of)
        : columns(from), pass(in), run(of), position_a(from.position + of.a), position_b(from.position + of.b),
          low(from.quarter_per_square + of.parameters), high(from.high + of.parameters),
          displacement_a(from.displacement + of.a), displacement_b(from.displacement + of.b), stride(from.stride) {}

    /// Solves a batch with common limits, or with limits for each link.
    [[gnu::always_inline]] void solve_uniform() const {
        if (run.count < width) return carefully(columns, pass, run, 0, run.count);
        const Wanted same = uniformly_wanted();
        solve([&](std::size_t) __attribute__((always_inline))->const Wanted& { return same; });
    }
    [[gnu::always_inline]] void solve_each() const {
        if (run.count < width) return carefully(columns, pass, run, 0, run.count);
        solve([&](std::size_t i) __attribute__((always_inline)) { return wanted_of(i); });
    }
    /// Solves a batch of either kind.
    [[gnu::always_inline]] void solve_any() const { run.uniform ? solve_uniform() : solve_each(); }

  private:
    using Wanted = sinew::Wanted<V>;
    using Link = RigidLink<D, V>;
    using Correction = RigidCorrection<D, Real, rules>;

    /// The last pack begins early enough to be full. Links in both of the last two packs are loaded before the first
    /// store, and solved twice with equal results.
    template <class Limits> [[gnu::always_inline]] void solve(Limits&& wanted) const {
        const std::size_t end = run.count, over = end % width, whole = over == 0 ? end : end - over - width;
        std::size_t i = 0;
        for (; i < whole; i += width)
            if (!all_near({i}, wanted)) [[unlikely]]
                carefully(columns, pass, run, i, i + width);
        if (over > 0 && !all_near({i, end - width}, wanted)) [[unlikely]]
            carefully(columns, pass, run, i, end);
    }

    /// Solves the packs from each number i on, if the tangent is accurate for all links (see lacking). Otherwise
    /// returns false and changes nothing.
    template <std::size_t packs, class Limits>
    [[gnu::always_inline]] bool all_near(const std::size_t (&i)[packs], Limits&& limits) const {
        Link link[packs];
        V half[packs], away[packs], before[packs];
#pragma GCC unroll 2
        for (unsigned p = 0; p < packs; ++p) {
            const Wanted& wanted = limits(i[p]);
            link[p] = link_at(i[p]);
            if constexpr (rules.kept) before[p] = multipliers<true>(i[p], int(width));
            half[p] = Correction::by_tangent(link[p], wanted, away[p]);
        }
        if (any_less(Correction::near() * Correction::near(), away)) [[unlikely]]
            return false;
#pragma GCC unroll 2
        for (unsigned p = 0; p < packs; ++p) {
            move<true>(i[p], int(width), link[p], half[p]);
            if constexpr (rules.kept) keep<true>(i[p], int(width), link[p], half[p], limits(i[p]), before[p]);
        }
        return true;
    }

    /// Solves links [first, last), however far from their limits.
    [[gnu::noinline]] static void carefully(const DistanceColumns<D, Real>& columns, DistancePass<Real>& pass,
                                            const LinkBatch& run, std::size_t first, std::size_t last) {
        const RigidLinks links(columns, pass, run);
        std::size_t i = first;
        for (; i + width <= last; i += width) links.template project<true>(i, int(width));
        if (i < last) links.template project<false>(i, int(last - i));
    }

    template <bool all> [[gnu::always_inline]] void project(std::size_t i, int count) const {
        const Wanted wanted = run.uniform ? uniformly_wanted() : wanted_of(i);
        Link link = link_at(i);
        const V half = Correction{pass}.template exact<all>(link, count, wanted);
        move<all>(i, count, link, half);
        if constexpr (rules.kept) keep<all>(i, count, link, half, wanted, multipliers<all>(i, count));
    }

    /// Stores the multipliers, the sums of all passes of a substep, and notes lengths near zero.
    template <bool all>
    [[gnu::always_inline]] void keep(std::size_t i, int count, const Link& link, const V& half, const Wanted& wanted,
                                     const V& before) const {
        const V length = root(link.e2), along = rules.old_gradient ? root(dot(link.d, link.d)) : length;
        V mobility = mobility_of(run.a + i);
        if constexpr (!rules.equal_mass) mobility = mean_mobility(mobility, mobility_of(run.b + i));
        if constexpr (!all) mobility = first_lanes(mobility, count, Real(1));
        const V added = along * half / mobility;
        const V lambda = within(pass.first ? added : before + added, spread<V>(limit::multiplier<Real>));
        const auto has_length = wanted.low < spread<V>(Real(0.1) * max_per_square<Real>);
        note<all>(i, count, lambda, has_length ? length : spread<V>(Real(1)));
    }

    template <bool all> [[gnu::always_inline]] V multipliers(std::size_t i, int count) const {
        if (pass.first) return V{};
        if (all && run.row_step == 1) return load<V>(columns.multiplier + run.row + i);
        Real numbers[width] = {};
        for (std::size_t k = 0; k < std::size_t(count); ++k) numbers[k] = columns.multiplier[row_of(i + k)];
        return load<V>(numbers);
    }
    std::size_t row_of(std::size_t i) const {
        return run.row_step == 0 ? columns.rows[run.row + i] : run.row + i * run.row_step;
    }

    [[gnu::always_inline]] Link link_at(std::size_t i) const {
        Link link;
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            const std::size_t at = k * stride + i;
            link.a[k] = load<V>(displacement_a + at);
            link.b[k] = load<V>(displacement_b + at);
            link.d[k] = load<V>(position_b + at) - load<V>(position_a + at);
            link.e[k] = link.d[k] + (link.b[k] - link.a[k]);
        }
        link.e2 = dot(link.e, link.e);
        return link;
    }
    template <bool all>
    [[gnu::always_inline]] void move(std::size_t i, int count, const Link& link, const V& half) const {
        const Shares shares = shares_of(i, half);
#pragma GCC unroll 3
        for (unsigned k = 0; k < D; ++k) {
            const std::size_t at = k * stride + i;
            const V& along = rules.old_gradient ? link.d[k] : link.e[k];
            const V first = along * shares.a, second = rules.equal_mass ? first : along * shares.b;
            put<all>(displacement_a + at, link.a[k] - first, count);
            put<all>(displacement_b + at, link.b[k] + second, count);
        }
    }

    /// Corrections of the ends, relative to the direction of correction.
    struct Shares {
        V a, b;
    };
    [[gnu::always_inline]] Shares shares_of(std::size_t i, const V& half) const {
        if constexpr (rules.equal_mass) return {half, half};
        const V a = mobility_of(run.a + i), b = mobility_of(run.b + i), per = Real(1) / mean_mobility(a, b);
        return {half * (per * a), half * (per * b)};
    }
    [[gnu::always_inline]] V mobility_of(std::size_t slot) const {
        return load<V>(columns.mobility + slot);
    }
    /// Mean of two mobilities; infinity if both ends are immovable, which gives no correction.
    [[gnu::always_inline]] static V mean_mobility(const V& a, const V& b) {
        const V mean = (a + b) * Real(0.5);
        return V{} < mean ? mean : spread<V>(std::numeric_limits<Real>::infinity());
    }

    template <bool all>
    [[gnu::always_inline]] void note(std::size_t i, int count, const V& lambda, const V& length) const {
        if (any(length < spread<V>(limit::shortest_link<Real>))) [[unlikely]]
            for (int k = 0; k < count; ++k) pass.shortest = min(pass.shortest, lane_of(length, k));
        if (run.row_step == 0) {
            for (int k = 0; k < count; ++k)
                columns.multiplier[columns.rows[run.row + i + std::size_t(k)]] = lane_of(lambda, k);
            return;
        }
        Real* const to = columns.multiplier + run.row + i * run.row_step;
        if (run.row_step == 1) return put<all>(to, lambda, count);
        store_strided<all>(to, lambda, count, run.row_step);
    }

    [[gnu::always_inline]] Wanted uniformly_wanted() const {
        return wanted(
            0, [](const Real* from) __attribute__((always_inline)) { return spread<V>(*from); });
    }
    [[gnu::always_inline]] Wanted wanted_of(std::size_t i) const {
        return wanted(
            i, [](const Real* from) __attribute__((always_inline)) { return load<V>(from); });
    }
    template <class Get> [[gnu::always_inline]] Wanted wanted(std::size_t at, Get&& get) const {
        Wanted wanted{get(low + at), V{}};
        if constexpr (!rules.equality) {
            const V longest = get(high + at);
            wanted.high = min(Real(0.25) / (longest * longest), spread<V>(Real(0.25) * max_per_square<Real>));
        }
        return wanted;
    }
};

/// Solves batches of a kind, up to the first of another. Not inlined: together with the other kinds registers would not
/// suffice.
template <LinkKind kind, bool kept, int D, class Real>
[[gnu::noinline]] const LinkBatch* project_kind(const DistanceColumns<D, Real>& columns, DistancePass<Real>& pass,
                                                const LinkBatch* first, const LinkBatch* last) {
    using enum LinkKind;
    constexpr Rigid rules{
        .equality = kind != inequality && kind != inequality_each && kind != inequality_uneven,
        .kept = kept,
        .old_gradient = kind == old_gradient || kind == old_gradient_each || kind == old_gradient_uneven,
        .equal_mass = kind != equality_uneven && kind != old_gradient_uneven && kind != inequality_uneven};
    for (; first != last && first->kind == kind; ++first) {
        const RigidLinks<D, Real, rules> links(columns, pass, *first);
        if constexpr (kind == equality || kind == old_gradient || kind == inequality)
            links.solve_uniform();
        else if constexpr (rules.equal_mass)
            links.solve_each();
        else
            links.solve_any();
    }
    return first;
}

/// Solves batches up to the first of kind `other`, or with multipliers to be accumulated. Equalities need multipliers
/// only for readers; inequalities also between iterations, to undo part of earlier corrections.
template <int D, class Real>
[[gnu::always_inline]] inline const LinkBatch* project_kinds(const DistanceColumns<D, Real>& columns,
                                                             DistancePass<Real>& pass, const LinkBatch* first,
                                                             const LinkBatch* last) {
    using enum LinkKind;
    using Project =
        const LinkBatch* (*)(const DistanceColumns<D, Real>&, DistancePass<Real>&, const LinkBatch*, const LinkBatch*);
    static constexpr auto each = [](auto kept) {
        return std::array<Project, 10>{nullptr,
                                       project_kind<equality, kept, D, Real>,
                                       project_kind<equality_each, kept, D, Real>,
                                       project_kind<equality_uneven, kept, D, Real>,
                                       project_kind<old_gradient, kept, D, Real>,
                                       project_kind<old_gradient_each, kept, D, Real>,
                                       project_kind<old_gradient_uneven, kept, D, Real>,
                                       project_kind<inequality, kept, D, Real>,
                                       project_kind<inequality_each, kept, D, Real>,
                                       project_kind<inequality_uneven, kept, D, Real>};
    };
    static constexpr std::array project{each(std::false_type{}), each(std::true_type{})};
    while (first != last && first->kind != other) {
        const bool is_equality = first->kind < inequality, kept = is_equality ? pass.last_substep : pass.kept;
        if (kept && !pass.first && !(is_equality && pass.adds)) break;
        first = project[kept][std::size_t(first->kind)](columns, pass, first, last);
    }
    return first;
}

} // namespace
} // namespace sinew

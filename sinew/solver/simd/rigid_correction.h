#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/simd/inverse_length.h"
#include "sinew/solver/simd/kernel.h"

namespace sinew {
namespace {

using namespace lane;

/// Variant of rigid links to compile a kernel for.
struct Rigid {
    bool equality = true;      ///< all links are equalities
    bool kept = false;         ///< multipliers are stored
    bool old_gradient = false; ///< corrected along the links at the start of the substep (simd/distance.h)
    bool equal_mass = true;    ///< both ends of every link have the same nonzero mobility
};

/// Ends of links in lanes.
template <int D, class V> struct RigidLink {
    V a[D], b[D]; ///< displacements of the ends
    V d[D], e[D]; ///< link at the start of the substep, link now
    V e2{};
};

/// Limits of the length, as 1 / (4 length^2).
template <class V> struct Wanted { V low, high; };

template <int D, class V> [[gnu::always_inline]] inline V dot(const V (&a)[D], const V (&b)[D]) {
    V sum = a[0] * b[0];
#pragma GCC unroll 3
    for (unsigned k = 1; k < D; ++k) sum = sum + a[k] * b[k];
    return sum;
}

/// Correction of rigid links: half of the change of length, relative to the direction of correction.
template <int D, class Real, Rigid rules> struct RigidCorrection {
    using V = Pack<Real, widest<Real>>;
    using Link = RigidLink<D, V>;

    DistancePass<Real>& pass;

    /// Correction by the tangent, accurate while `away` is at most near()^2.
    [[gnu::always_inline]] static V by_tangent(const Link& link, const Wanted<V>& wanted, V& away) {
        V half = half_tangent(link.e2, wanted);
        away = half * half;
        if constexpr (rules.old_gradient) {
            const V turned = quarter() - dot(link.d, link.e) * wanted.low;
            away = max(away, turned * turned);
            half = along_tangent(half, turned);
        }
        return half;
    }
    /// Largest `half` for the tangent; larger values take a square root.
    [[gnu::always_inline]] static V near() { return spread<V>(Real(1.0 / 128)); }

    /// Correction however far from the limits; the direction may change.
    template <bool all> [[gnu::always_inline]] V exact(Link& link, int count, const Wanted<V>& wanted) const {
        if constexpr (rules.old_gradient) return by_old_length<all>(link, count, wanted);
        return by_length<all>(link.e2, count, wanted);
    }

  private:
    /// Half of the relative correction: the share of each end with equal mobilities.
    template <bool all> [[gnu::always_inline]] V by_length(const V& e2, int count, const Wanted<V>& wanted) const {
        V half = half_tangent(e2, wanted);
        if constexpr (!all) half = first_lanes(half, count, Real(0));
        return lacking(
            half, Real(0.5), [&]() __attribute__((always_inline)) {
                look_at(half);
                if constexpr (rules.equality) return e2 * wanted.low * Real(4);
                return e2 * (half < V{} ? wanted.high : wanted.low) * Real(4);
            });
    }

    /// Half of the correction relative to d, the link at the start of the substep; e is the link now:
    ///
    ///     (1/sqrt(t) - 1)/2 t/u,   t = e^2 / L^2,   u = d e / L^2;   near t = u = 1 about (1 - t)/4 (2 - u)
    ///
    /// Where the link has turned by more than 8 degrees or is at least twice too long, d becomes e.
    template <bool all> [[gnu::always_inline]] V by_old_length(Link& link, int count, const Wanted<V>& wanted) const {
        auto& [a, b, d, e, e2] = link;
        const V d_e = dot(d, e);
        V half = half_tangent(e2, wanted), turned = quarter() - d_e * wanted.low;
        if constexpr (!all) half = first_lanes(half, count, Real(0)), turned = first_lanes(turned, count, Real(0));
        const V nearly = along_tangent(half, turned), away = max(half * half, turned * turned);
        if (!any_less(near() * near(), away)) return nearly;
        look_at(half);
        const V t = e2 * wanted.low * Real(4), one = spread<V>(Real(1)), zero{};
        V along = turned * turned < spread<V>(Real(1.0 / 64)) ? d_e : zero; // u from 1/2 to 3/2
        along = t < spread<V>(Real(4)) ? along : zero;
        const auto agree = along * along > Real(min_agreement * min_agreement) * (e2 * dot(d, d));
        const V lack = Real(0.5) / root(max(t, spread<V>(Real(1e-30)))) - Real(0.5);
        const V part = lack * ((agree ? e2 : one) / (agree ? along : one));
        for (unsigned k = 0; k < D; ++k) d[k] = near() * near() < away ? (agree ? d[k] : e[k]) : d[k];
        return near() * near() < away ? part : nearly;
    }

    [[gnu::always_inline]] void look_at(const V& half) const {
        if (any(half < spread<V>(Real(0.25) * (1 - pass.overstretched_from)))) pass.overstretched = true;
    }

    [[gnu::always_inline]] static V quarter() { return spread<V>(Real(0.25)); }

    [[gnu::always_inline]] static V half_tangent(const V& e2, const Wanted<V>& wanted) {
        const V half = quarter() - e2 * wanted.low, zero{};
        return rules.equality ? half : max(half, zero) + min(quarter() - e2 * wanted.high, zero);
    }
    [[gnu::always_inline]] static V along_tangent(const V& half, const V& turned) {
        return half * (turned * Real(4) + Real(1));
    }
};

} // namespace
} // namespace sinew

#pragma once

#include "sinew/solver/contact/contact_room.h"

#include <limits>
#include <span>

/// Passes over rows of contact until they agree, by nonlinear conjugate gradients (Silcowitz-Hansen, Niebe and Erleben
/// 2010), x being all impulses:
///
///     x' = pass(x);  r = x' - x;  b = |r|^2 / |r before|^2;   x'' = x' + b p,   p = b p + r,   anew where b > 1
namespace sinew::detail {

/// Number of passes, and change in the last one, of all impulses.
template <class Real> struct Settling {
    int most = 1;
    Real exact = 0;
};

/// Calls solve(number, row, origin) for each row in a pass, and add(number, row, impulse) between passes.
template <int D, class Real, class Solve, class Add>
void settle_rows(ContactRoom<D, Real>& room, std::span<IslandRow<D, Real>> rows, const Settling<Real>& until,
                 const Solve& solve, const Add& add) {
    const auto row_of = [&](const IslandRow<D, Real>& one) -> auto& {
        return room.parts.list[one.part].rows[one.row];
    };
    const auto impulse_of = [&](const IslandRow<D, Real>& one) {
        return row_of(one).normal * row_of(one).multiplier + row_of(one).tangent;
    };
    const Real exact = max(until.exact, Real(16) * std::numeric_limits<Real>::epsilon());
    Real before = 0;
    for (int pass = 1;; ++pass) {
        Real size = 0, changed = 0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            auto& one = rows[i];
            const auto impulse = impulse_of(one);
            solve(i, row_of(one), room.parts.list[one.part].origins[one.row]);
            one.change = impulse_of(one) - impulse;
            size += dot(impulse, impulse), changed += dot(one.change, one.change);
        }
        if (pass >= until.most || !(changed > square(exact) * size)) return;
        const Real share = before > Real(0) && changed <= before ? changed / before : Real(0);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            auto& one = rows[i];
            one.direction *= share;
            if (share > Real(0)) add(i, row_of(one), one.direction);
            one.direction += one.change;
        }
        before = changed;
    }
}

} // namespace sinew::detail

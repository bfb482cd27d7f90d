#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/row_solver.h"

#include <tuple>

/// Rows of contact between bodies of unlike masses: one pass would move a light body under a heavy one to and fro
/// between it and the floor, and each time take from the heavy one a share of its speed as small as the ratio of the
/// masses. The rows of such an island of bodies are solved together until they agree, by nonlinear conjugate gradients
/// on passes (Silcowitz-Hansen, Niebe and Erleben 2010):
///
///     x' = pass(x);  r = x' - x;  b = |r|^2 / |r before|^2;   x'' = x' + b p,   p = b p + r,   anew where b > 1
namespace sinew::detail {

template <int D, class Real> class RowIslands {
  public:
    using Vector = Vec<D, Real>;
    using RowT = ContactRow<D, Real>;

    RowIslands(ContactRoom<D, Real>& room, const SweepState<D, Real>& state) : room_(room), state_(state) {}

    /// Lists and marks the rows of uneven islands, once they are made.
    void find() {
        auto& rows = room_.island_rows;
        rows.clear();
        if (!(room_.projector.unevenness() > uneven)) return;
        join_bodies();
        weigh_islands();
        for (std::uint32_t i = 0; i < contact_parts; ++i) {
            auto& part = room_.parts.list[i];
            for (std::uint32_t k = 0; k < part.rows.size(); ++k)
                if (const auto island = island_of(part.rows[k]); island != none && unevenness(island) > uneven) {
                    part.rows[k].is_repeated = true;
                    rows.push_back({.island = island, .part = i, .row = k});
                }
        }
        sinew::sort(rows.begin(), rows.end(), [](const Listed& a, const Listed& b) {
            return std::tie(a.island, a.part, a.row) < std::tie(b.island, b.part, b.row);
        });
    }
    /// Solves all islands for the rows for which acts(row, origin). `soften`: softness for the mass that a row carries,
    /// as a multiple of what it moves.
    template <class Acts, class Soften>
    void solve(const RowSolver<D, Real>& solver, const Soften& soften, const Acts& acts) {
        const auto all = std::span(room_.island_rows);
        for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
            while (last < all.size() && all[last].island == all[first].island) ++last;
            const Real load = unevenness(all[first].island);
            solve(solver, all.subspan(first, last - first), load, soften(load), acts);
        }
    }

  private:
    using Listed = IslandRow<D, Real>;
    static constexpr Real uneven = 2; ///< ratio of masses that one pass a substep copes with
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    ContactRoom<D, Real>& room_;
    const SweepState<D, Real>& state_;

    /// Body of the first member that can move, if the row is one of those repeated.
    std::uint32_t body_of(const RowT& row) const {
        if (row.is_held || !row.keeps) return none;
        for (std::size_t i = 0; i < std::size_t(row.members); ++i)
            if (state_.mobility[row.slot[i]] > Real(0)) return room_.projector.body_of(row.slot[i]);
        return none;
    }
    std::uint32_t island_of(const RowT& row) {
        const auto body = body_of(row);
        return body == none ? none : room_.groups.first_of(body);
    }
    template <class Visit> void each_movable(const Visit& visit) {
        for (const auto& part : room_.parts.list)
            for (const auto& row : part.rows)
                if (const auto body = body_of(row); body != none)
                    for (std::size_t i = 0; i < std::size_t(row.members); ++i)
                        if (state_.mobility[row.slot[i]] > Real(0)) visit(body, room_.projector.body_of(row.slot[i]));
    }
    void join_bodies() {
        auto& groups = room_.groups;
        groups.make_room(room_.projector.bodies());
        each_movable([&](std::uint32_t, std::uint32_t other) { groups.separate(other); });
        each_movable([&](std::uint32_t body, std::uint32_t other) { groups.join(body, other); });
    }
    void weigh_islands() {
        room_.islands.resize(room_.projector.bodies());
        each_movable([&](std::uint32_t, std::uint32_t other) { room_.islands[other] = {}; });
        each_movable([&](std::uint32_t, std::uint32_t other) {
            auto& island = room_.islands[room_.groups.first_of(other)];
            const Real mass = room_.projector.mass_of_body(other);
            island.lightest = min(island.lightest, mass), island.heaviest = max(island.heaviest, mass);
        });
    }
    Real unevenness(std::uint32_t island) const {
        const auto& one = room_.islands[island];
        return one.heaviest * inverse_or_zero(one.lightest);
    }

    RowT& row_of(const Listed& one) { return room_.parts.list[one.part].rows[one.row]; }
    const ContactOrigin<D, Real>& origin_of(const Listed& one) { return room_.parts.list[one.part].origins[one.row]; }
    static Vector impulse_of(const RowT& row) { return row.normal * row.multiplier + row.tangent; }

    /// `load`: unevenness of the island.
    template <class Acts>
    void solve(const RowSolver<D, Real>& solver, std::span<Listed> island, Real load, const Softness<Real>& soft,
               const Acts& acts) {
        const int most = int(min(Real(2) * load, Real(256)));
        const Real exact = max(Real(1e-3) / load, Real(16) * std::numeric_limits<Real>::epsilon()); // of all impulses
        Real before = 0;
        for (int i = 0;; ++i) {
            Real size = 0, changed = 0;
            for (auto& one : island) {
                const auto impulse = impulse_of(row_of(one));
                if (acts(row_of(one), origin_of(one)))
                    solver.solve(row_of(one), soft, origin_of(one).surface_displacement);
                one.change = impulse_of(row_of(one)) - impulse;
                size += dot(impulse, impulse), changed += dot(one.change, one.change);
            }
            if (i + 1 == most || !(changed > square(exact) * size)) return;
            go_on(solver, island, before > Real(0) && changed <= before ? changed / before : Real(0));
            before = changed;
        }
    }
    /// Adds a share of the last direction, and takes up the new one.
    void go_on(const RowSolver<D, Real>& solver, std::span<Listed> island, Real share) {
        for (auto& one : island) {
            one.direction *= share;
            if (share > Real(0)) solver.add(row_of(one), one.direction);
            one.direction += one.change;
        }
    }
};

} // namespace sinew::detail

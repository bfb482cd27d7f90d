#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/row_solver.h"
#include "sinew/solver/contact/settle_rows.h"

#include <tuple>

/// Rows of contact between bodies of unlike masses: one pass would move a light body under a heavy one to and fro
/// between it and the floor, and each time take from the heavy one a share of its speed as small as the ratio of the
/// masses. The rows of such an island of bodies are solved together until they agree (settle_rows.h).
namespace sinew::detail {

template <int D, class Real> class RowIslands {
  public:
    using Vector = Vec<D, Real>;
    using RowT = ContactRow<D, Real>;
    using Origin = ContactOrigin<D, Real>;

    RowIslands(ContactRoom<D, Real>& room, const SweepState<D, Real>& state) : room_(room), state_(state) {}

    /// Lists the rows of uneven islands and those held, once they are made, and marks the former.
    void find() {
        find_held();
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
        sort(rows);
    }
    /// Solves all islands for the rows for which acts(row, origin). `soften`: softness for the mass that a row carries,
    /// as a multiple of the mass it moves.
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

    void find_held() {
        auto& rows = room_.held_rows;
        rows.clear();
        for (std::uint32_t i = 0; i < contact_parts; ++i)
            for (const auto& one : room_.parts.list[i].held)
                rows.push_back({.island = one.component, .part = i, .row = one.row});
        sort(rows);
    }
    static void sort(std::vector<Listed>& rows) {
        sinew::sort(rows.begin(), rows.end(), [](const Listed& a, const Listed& b) {
            return std::tie(a.island, a.part, a.row) < std::tie(b.island, b.part, b.row);
        });
    }
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

    /// `load`: unevenness of the island.
    template <class Acts>
    void solve(const RowSolver<D, Real>& solver, std::span<Listed> island, Real load, const Softness<Real>& soft,
               const Acts& acts) {
        settle_rows(
            room_, island, {.most = int(min(Real(2) * load, Real(256))), .exact = Real(1e-3) / load},
            [&](std::size_t, RowT& row, const Origin& origin) {
                if (acts(row, origin)) solver.solve(row, soft, origin.surface_displacement);
            },
            [&](std::size_t, RowT& row, const Vector& impulse) { solver.add(row, impulse); });
    }
};

} // namespace sinew::detail

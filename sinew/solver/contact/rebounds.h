#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/contact/held_rows.h"

/// Blows of figures on walls, at the end of a substep, and restitution. With v- and v+ the velocities of a contact
/// along its normal before and after, and lambda its impulse,
///
///     v+ >= target,   lambda >= 0,   lambda (v+ - target) = 0;     target = -e v- after a blow, else 0
///
/// for all contacts of a figure at once (Newton's law; Moreau 1988), as the whole figure answers with its links held.
/// With one e the energy changes by (1 - e) lambda v- / 2 <= 0; where walls differ in it, a share of the rebound is
/// taken such that lambda (v- + v+) / 2 sums up to no gain.
namespace sinew::detail {

template <int D, class Real> class Rebounds {
  public:
    using RowT = ContactRow<D, Real>;
    using Part = ContactPart<D, Real>;
    using Rebounding = ReboundRow<Real>;

    /// `resting`: displacement that forces add in a substep.
    Rebounds(ContactRoom<D, Real>& room, SweepState<D, Real>& state, const RowSolver<D, Real>& rows, Real resting)
        : room_(room), state_(state), rows_(rows), held_(room, state, rows), resting_(resting) {}

    void run() {
        list();
        const auto& all = room_.rebounds;
        for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
            while (last < all.size() && all[last].body == all[first].body) ++last;
            const auto body = std::span(room_.rebounds).subspan(first, last - first);
            if (std::ranges::any_of(body, &Rebounding::is_struck)) solve(body);
        }
        forget_blows();
    }

  private:
    static constexpr auto none = RigidLinks<D, Real>::none;
    ContactRoom<D, Real>& room_;
    SweepState<D, Real>& state_;
    const RowSolver<D, Real>& rows_;
    HeldRows<D, Real> held_;
    Real resting_;

    Part& part_of(const Rebounding& one) { return room_.parts.list[one.part]; }
    RowT& row_of(const Rebounding& one) { return part_of(one).rows[one.row]; }
    Real change(const Rebounding& one) {
        return rows_.change(row_of(one), part_of(one).origins[one.row].surface_displacement);
    }

    /// Rows of walls, body by body, if some wall has been struck.
    void list() {
        auto& all = room_.rebounds;
        all.clear();
        bool any = false;
        for (std::uint32_t i = 0; i < contact_parts; ++i) {
            const auto& part = room_.parts.list[i];
            for (auto k = part.first_wall; k < part.rows.size(); ++k) {
                const auto away = away_after(part.rows[k], part.origins[k]);
                any = any || away;
                const auto& row = part.rows[k];
                all.push_back({.body = body_of(row),
                               .part = i,
                               .row = std::uint32_t(k),
                               .is_struck = away.has_value(),
                               .target = away ? *away : -max(row.gap, Real(0)),
                               .begun = row.multiplier});
            }
        }
        if (!any) return all.clear();
        sinew::sort(all.begin(), all.end(), [](const Rebounding& a, const Rebounding& b) {
            return std::tie(a.body, a.part, a.row) < std::tie(b.body, b.part, b.row);
        });
    }
    std::optional<Real> away_after(const RowT& row, const ContactOrigin<D, Real>& origin) const {
        if (origin.restitution == Real(0) || row.max == Real(0)) return std::nullopt;
        return rebound_after(origin.approach, origin.restitution, resting_);
    }
    /// Component of the links, or `none`.
    std::uint32_t body_of(const RowT& row) const {
        const auto& component_of = room_.projector.links().component_of;
        const auto first = component_of[row.slot[0]];
        return first != none || row.members < 2 ? first : component_of[row.slot[1]];
    }

    void solve(std::span<Rebounding> body) {
        constexpr int enough = 50;         // a crate five times as high as wide needs forty
        constexpr Real exact = Real(1e-4); // of the fastest rebound
        Real fastest = 0;
        for (auto& one : body) {
            one.mass = held_.mass_of(row_of(one));
            one.change = change(one);
            if (one.is_struck) fastest = max(fastest, one.target);
        }
        for (int i = 0; i < enough; ++i) {
            Real corrected = 0;
            for (const auto& one : body) corrected = max(corrected, correct(one));
            if (corrected <= exact * fastest) break;
        }
        take_back_gain(body);
    }
    /// The impulse of a blow is no load that goes on into the next substep.
    void forget_blows() {
        for (auto& part : room_.parts.list)
            for (auto k = part.first_wall; k < part.rows.size(); ++k)
                if (rebound_after(part.origins[k].approach, Real(1), resting_)) {
                    part.origins[k].pushed += part.rows[k].multiplier;
                    part.rows[k].multiplier = 0;
                }
    }
    /// Returns the velocity corrected, as a displacement.
    Real correct(const Rebounding& one) {
        auto& row = row_of(one);
        const Real lacking = one.target - change(one);
        const Real next = min(max(row.multiplier + lacking * one.mass, Real(0)), limit::multiplier<Real>);
        const Real added = next - row.multiplier;
        push(row, added);
        return absolute(added) * inverse_or_zero(one.mass);
    }
    void push(RowT& row, Real impulse) {
        if (impulse == Real(0)) return;
        held_.push(row, impulse);
        row.multiplier += impulse;
    }

    /// With impulses lambda + s dlambda the velocities are v + s dv: the work of the walls is a parabola over s.
    void take_back_gain(std::span<Rebounding> body) {
        Real a = 0, b = 0, c = 0;
        for (const auto& one : body) {
            const Real before = -part_of(one).origins[one.row].approach + one.change, added = change(one) - one.change;
            const Real more = row_of(one).multiplier - one.begun;
            a += more * added, b += more * before + one.begun * added, c += one.begun * before;
        }
        if (!(a + b + c > Real(0))) return;
        const Real root = square_root(max(square(b) - Real(4) * a * c, Real(0)));
        const Real share = clamp((root - b) * inverse_or_zero(Real(2) * a), Real(0), Real(1));
        for (const auto& one : body) {
            auto& row = row_of(one);
            push(row, (share - Real(1)) * (row.multiplier - one.begun));
        }
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/contact/held_rows.h"

/// Blows of figures on walls with restitution, before the figures move in a substep. With v- and v+ the velocities of a
/// contact along its normal before and after, and lambda its impulse,
///
///     v+ >= target,   lambda >= 0,   lambda (v+ - target) = 0;     target = -e v- after a blow, else nothing sinks in
///
/// for all contacts of a figure at once (Newton's law; Moreau 1988), as the whole figure answers with its links held;
/// then friction, by as much as stops the slip and at most its coefficient times lambda; and again, until nothing
/// approaches (generalised reflections: Smith et al. 2012). Velocities are those at the start of the substep, without
/// the half of what the forces add. With one e the energy changes by (1 - e) lambda v- / 2 <= 0; where walls differ in
/// it, a share of the impulses is taken such that lambda (v- + v+) / 2 sums up to no gain.
namespace sinew::detail {

template <int D, class Real> class Rebounds {
  public:
    using RowT = ContactRow<D, Real>;
    using Part = ContactPart<D, Real>;
    using Rebounding = ReboundRow<Real>;

    /// `h`: length of the substep.
    Rebounds(ContactRoom<D, Real>& room, SweepState<D, Real>& state, const RowSolver<D, Real>& rows, Real h)
        : room_(room), state_(state), rows_(rows), held_(&room, state, rows), resting_(square(h) * norm(state.gravity)),
          added_(state.gravity * (Real(0.5) * square(h))) {}

    /// Before the move.
    void run() {
        list();
        const auto& all = room_.rebounds;
        for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
            while (last < all.size() && all[last].body == all[first].body) ++last;
            reflect(std::span(room_.rebounds).subspan(first, last - first));
        }
    }
    /// True for a row that strikes its wall in the next substep, and rebounds then: until then nothing slows it down.
    bool awaits_blow(const RowT& row, const ContactOrigin<D, Real>& origin) const {
        return origin.restitution > Real(0) &&
               rebound_after(-rows_.change(row, origin.surface_displacement), Real(1), resting_);
    }
    /// After the move: the impulse of a blow is no load that goes on into the next substep.
    void forget_blows() {
        for (auto& part : room_.parts.list)
            for (auto k = part.first_wall; k < part.rows.size(); ++k)
                if (rebound_after(part.origins[k].approach, Real(1), resting_)) {
                    part.origins[k].pushed += part.rows[k].multiplier;
                    part.rows[k].multiplier = 0;
                }
    }

  private:
    static constexpr auto none = RigidLinks<D, Real>::none;
    ContactRoom<D, Real>& room_;
    SweepState<D, Real>& state_;
    const RowSolver<D, Real>& rows_;
    HeldRows<D, Real> held_;
    Real resting_;
    Vec<D, Real> added_; ///< displacement by half of what gravity adds in the substep

    Part& part_of(const Rebounding& one) { return room_.parts.list[one.part]; }
    RowT& row_of(const Rebounding& one) { return part_of(one).rows[one.row]; }
    Real change(const Rebounding& one) {
        return rows_.change(row_of(one), part_of(one).origins[one.row].surface_displacement);
    }

    /// Rows of walls, body by body, if some wall may be struck.
    void list() {
        auto& all = room_.rebounds;
        all.clear();
        bool any = false;
        for (std::uint32_t i = 0; i < contact_parts; ++i) {
            const auto& part = room_.parts.list[i];
            for (auto k = part.first_wall; k < part.rows.size(); ++k) {
                const auto& row = part.rows[k];
                any = any || (part.origins[k].restitution > Real(0) &&
                              rebound_after(part.origins[k].approach, Real(1), resting_));
                all.push_back(
                    {.body = body_of(row), .part = i, .row = std::uint32_t(k), .added = dot(row.normal, added_)});
            }
        }
        if (!any) return all.clear();
        sinew::sort(all.begin(), all.end(), [](const Rebounding& a, const Rebounding& b) {
            return std::tie(a.body, a.part, a.row) < std::tie(b.body, b.part, b.row);
        });
    }
    /// Component of the links, or `none`.
    std::uint32_t body_of(const RowT& row) const {
        const auto& component_of = room_.projector.links().component_of;
        const auto first = component_of[row.slot[0]];
        return first != none || row.members < 2 ? first : component_of[row.slot[1]];
    }

    void reflect(std::span<Rebounding> body) {
        constexpr int most = 10; // blows of a body in a substep: a rod that rattles between a wall and the floor
        for (int i = 0; i < most && set_targets(body); ++i) {
            solve(body);
            take_back_gain(body);
            rub(body);
            for (const auto& one : body) note(one);
        }
    }
    /// True if something strikes.
    bool set_targets(std::span<Rebounding> body) {
        bool any = false;
        for (auto& one : body) {
            const auto& origin = part_of(one).origins[one.row];
            const Real gap = max(row_of(one).gap, Real(0));
            one.before = change(one), one.impulse = 0, one.target = min(-gap, one.before);
            if (origin.restitution == Real(0) || !(gap + one.before < Real(0))) continue;
            if (const auto away = rebound_after(-one.before, origin.restitution, resting_)) {
                one.target = *away + (Real(1) + origin.restitution) * one.added;
                any = true;
            }
        }
        return any;
    }
    void solve(std::span<Rebounding> body) {
        constexpr int enough = 50;         // a crate five times as high as wide needs forty
        constexpr Real exact = Real(1e-6); // of the fastest rebound
        Real fastest = 0;
        for (auto& one : body) {
            if (one.mass == Real(0)) one.mass = held_.mass_of(row_of(one));
            fastest = max(fastest, one.target);
        }
        for (int i = 0; i < enough; ++i) {
            Real corrected = 0;
            for (auto& one : body) corrected = max(corrected, correct(one));
            if (corrected <= exact * fastest) break;
        }
    }
    /// Returns the velocity corrected, as a displacement.
    Real correct(Rebounding& one) {
        const Real lacking = one.target - change(one);
        const Real next = min(max(one.impulse + lacking * one.mass, Real(0)), limit::multiplier<Real>);
        const Real added = next - one.impulse;
        push(one, added);
        return absolute(added) * inverse_or_zero(one.mass);
    }
    void push(Rebounding& one, Real impulse) {
        if (impulse == Real(0)) return;
        held_.push(row_of(one), impulse);
        one.impulse += impulse;
    }
    /// With the share s of the impulses the velocities are v + s dv: the work of the walls is a parabola over s.
    void take_back_gain(std::span<Rebounding> body) {
        Real a = 0, b = 0;
        for (const auto& one : body) {
            a += one.impulse * (change(one) - one.before);
            b += one.impulse * Real(2) * (one.before - one.added);
        }
        if (!(a + b > Real(0))) return;
        const Real share = clamp(-b * inverse_or_zero(a), Real(0), Real(1));
        for (auto& one : body) push(one, (share - Real(1)) * one.impulse);
    }
    /// Friction of the blow. Each impulse takes energy.
    void rub(std::span<Rebounding> body) {
        for (auto& one : body) {
            const auto& row = row_of(one);
            if (!(row.friction > Real(0)) || !(one.impulse > Real(0))) continue;
            const auto moved = rows_.relative_displacement(row) - part_of(one).origins[one.row].surface_displacement;
            auto along = row;
            along.normal = -direction(moved - row.normal * dot(row.normal, moved));
            const Real slip = -dot(along.normal, moved);
            if (slip > Real(0)) held_.push(along, min(slip * held_.mass_of(along), row.friction * one.impulse));
        }
    }
    void note(const Rebounding& one) {
        auto& row = row_of(one);
        row.max = max(row.max, row.multiplier + one.impulse);
        part_of(one).origins[one.row].pushed += one.impulse;
    }
};

} // namespace sinew::detail

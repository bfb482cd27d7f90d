#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/contact/delassus.h"

/// Blows with restitution, before the figures move in a substep. With v- and v+ the velocities of a contact along its
/// normal before and after, and lambda its impulse,
///
///     v+ >= target,   lambda >= 0,   lambda (v+ - target) = 0;     target = -e v- after a blow, else nothing sinks in
///
/// for all contacts of a group at once (Newton's law; Moreau 1988), as the whole figures answer with their links held;
/// then friction, by as much as stops the slip and at most its coefficient times lambda; and again, until nothing
/// approaches (generalised reflections: Smith et al. 2012). A group is a figure with its walls, or figures that
/// contacts with restitution join. These take part in a reflection once they approach: a blow on one end of a row of
/// balls leaves at the other. Velocities are those at the start of the substep, without the half of what the forces
/// add. With one e the energy changes by (1 - e) lambda v- / 2 <= 0; where contacts differ in it, a share of the
/// impulses is taken such that lambda (v- + v+) / 2 sums up to no gain.
namespace sinew::detail {

template <int D, class Real> class Rebounds {
  public:
    using RowT = ContactRow<D, Real>;
    using Part = ContactPart<D, Real>;
    using Rebounding = ReboundRow<Real>;
    /// In a substep; a rod that rattles between a wall and the floor takes ten. Then its rows hold it.
    static constexpr std::uint32_t strikes_of_row = 10;

    /// `h`: length of the substep.
    Rebounds(ContactRoom<D, Real>& room, SweepState<D, Real>& state, const RowSolver<D, Real>& rows, Real h)
        : room_(room), state_(state), rows_(rows), figures_(room, state, rows),
          resting_(square(h) * norm(state.gravity)), added_(state.gravity * (Real(0.5) * square(h))) {}

    /// Before the move.
    void run() {
        list();
        const auto& all = room_.rebounds;
        for (std::size_t first = 0, last = 0; first < all.size(); first = last) {
            while (last < all.size() && all[last].group == all[first].group) ++last;
            reflect(std::span(room_.rebounds).subspan(first, last - first));
        }
    }
    /// True for a row that strikes in the next substep, and rebounds then: until then nothing slows it down.
    /// `change_of()`: change of its gap in a substep.
    template <class ChangeOf> bool awaits_blow(const ContactOrigin<D, Real>& origin, const ChangeOf& change_of) const {
        return origin.restitution > Real(0) && rebound_after(-change_of(), Real(1), resting_);
    }
    /// After the move: the impulse of a blow is no load that goes on into the next substep.
    void forget_blows() {
        for (auto& part : room_.parts.list)
            for (std::size_t k = 0; k < part.rows.size(); ++k)
                if (is_blow(part, k)) {
                    part.origins[k].pushed += part.rows[k].multiplier;
                    part.rows[k].multiplier = 0, part.rows[k].tangent = {};
                }
    }

  private:
    ContactRoom<D, Real>& room_;
    SweepState<D, Real>& state_;
    const RowSolver<D, Real>& rows_;
    Delassus<D, Real> figures_;
    Real resting_;
    Vec<D, Real> added_; ///< displacement by half of what gravity adds in the substep

    bool is_wall(const Rebounding& one) { return one.row >= part_of(one).first_wall; }
    Part& part_of(const Rebounding& one) { return room_.parts.list[one.part]; }
    RowT& row_of(const Rebounding& one) { return part_of(one).rows[one.row]; }
    /// Rows of walls, and those between figures that rebound from each other.
    static bool takes_part(const Part& part, std::size_t row) {
        return row >= part.first_wall || part.origins[row].restitution > Real(0);
    }
    /// Figures that do not rebound press each other as they settle: only an approach much faster than that, and than a
    /// hundredth of their radii in a substep, is a blow.
    bool is_blow(const Part& part, std::size_t row) const {
        const auto& origin = part.origins[row];
        if (takes_part(part, row)) return rebound_after(origin.approach, Real(1), resting_).has_value();
        return origin.approach > max(Real(40) * resting_, Real(0.01) * origin.thickness);
    }
    /// Rows of blows group by group, if something may strike.
    void list() {
        auto& all = room_.rebounds;
        all.clear();
        bool any = false, joins = false;
        for (std::uint32_t i = 0; i < contact_parts; ++i) {
            const auto& part = room_.parts.list[i];
            for (std::size_t k = 0; k < part.rows.size(); ++k) {
                if (!takes_part(part, k)) continue;
                any = any || (part.origins[k].restitution > Real(0) &&
                              rebound_after(part.origins[k].approach, Real(1), resting_));
                joins = joins || k < part.first_wall;
                all.push_back({.part = i,
                               .row = std::uint32_t(k),
                               .added = added_of(part.rows[k]),
                               .of_surface = dot(part.rows[k].normal, part.origins[k].surface_displacement)});
            }
        }
        if (!any) return all.clear();
        if (joins) join_bodies();
        for (auto& one : all) one.group = joins ? room_.groups.first_of(body_of(row_of(one))) : body_of(row_of(one));
        sinew::sort(all.begin(), all.end(), [](const Rebounding& a, const Rebounding& b) {
            return std::tie(a.group, a.part, a.row) < std::tie(b.group, b.part, b.row);
        });
    }
    /// Displacement of a contact by `added_`.
    Real added_of(const RowT& row) const {
        Real share = 0;
        for (std::size_t i = 0; i < row.members; ++i)
            if (state_.mobility[row.slot[i]] > Real(0)) share += row.weight[i];
        return share * dot(row.normal, added_);
    }
    /// Figures that a row meets are of one group; immovable members pass no blow on.
    void join_bodies() {
        auto& groups = room_.groups;
        groups.make_room(room_.projector.bodies());
        for (const auto& one : room_.rebounds)
            for (const Row slot : row_of(one).slots()) groups.separate(body_of(slot));
        for (const auto& one : room_.rebounds)
            for (const Row slot : row_of(one).slots())
                if (state_.mobility[slot] > Real(0)) groups.join(body_of(row_of(one)), body_of(slot));
    }
    std::uint32_t body_of(Row slot) const { return room_.projector.body_of(slot); }
    /// Body of the first member that can move.
    std::uint32_t body_of(const RowT& row) const {
        const auto members = row.slots();
        const auto first = std::ranges::find_if(members, [&](Row slot) { return state_.mobility[slot] > Real(0); });
        return body_of(first != members.end() ? *first : members[0]);
    }

    void reflect(std::span<Rebounding> body) {
        const auto most = strikes_of_row + min(body.size(), std::size_t(90)); // through a row of balls one by one
        figures_.begin([&](const auto& add) {
            for (const auto& one : body) add(row_of(one));
        });
        for (std::size_t i = 0; i < most && set_targets(body); ++i) {
            solve(body);
            figures_.finish();
            take_back_gain(body);
            rub(body);
            figures_.finish();
            for (const auto& one : body) note(one);
        }
        for (const auto& one : body)
            if (one.strikes > 0)
                for (const Row slot : row_of(one).slots()) room_.projector.note_blow(state_, slot);
    }
    /// Displacement of a contact from its wall, along the normal.
    Real change(std::span<const Rebounding> body, std::size_t i) const {
        return dot(figures_.row(i).normal, figures_.moved(i)) - body[i].of_surface;
    }
    /// True if something strikes.
    bool set_targets(std::span<Rebounding> body) {
        bool any = false;
        for (std::size_t i = 0; i < body.size(); ++i) {
            auto& one = body[i];
            const auto& origin = part_of(one).origins[one.row];
            const Real gap = max(row_of(one).gap, Real(0));
            one.before = change(body, i), one.impulse = 0;
            one.target = is_wall(one) ? min(-gap, one.before) : -limit::measure<Real>;
            if (one.strikes == strikes_of_row || origin.restitution == Real(0)) continue;
            const auto away = rebound_after(-one.before, origin.restitution, resting_);
            if (!away) continue;
            one.target = -limit::measure<Real>; // the next contact of the substep strikes by itself
            if (!(gap + one.before < Real(0))) continue;
            one.target = *away + (Real(1) + origin.restitution) * one.added;
            ++one.strikes;
            any = true;
        }
        return any;
    }
    void solve(std::span<Rebounding> body) {
        constexpr int enough = 50;         // a crate five times as high as wide needs forty
        constexpr Real exact = Real(1e-6); // of the fastest rebound
        Real fastest = 0;
        for (const auto& one : body) fastest = max(fastest, one.target);
        for (int pass = 0; pass < enough; ++pass) {
            Real corrected = 0;
            for (std::size_t i = 0; i < body.size(); ++i) corrected = max(corrected, correct(body, i));
            if (corrected <= exact * fastest) break;
        }
    }
    /// Returns the velocity corrected, as a displacement.
    Real correct(std::span<Rebounding> body, std::size_t i) {
        auto& one = body[i];
        const Real lacking = one.target - change(body, i);
        if (!(lacking > Real(0)) && one.impulse == Real(0)) return 0;
        const Real mass = figures_.mass(i);
        const Real next = clamp(one.impulse + lacking * mass, Real(0), limit::multiplier<Real>);
        const Real added = next - one.impulse;
        push(body, i, added);
        return absolute(added) * inverse_or_zero(mass);
    }
    void push(std::span<Rebounding> body, std::size_t i, Real impulse) {
        figures_.push(i, figures_.row(i).normal * impulse);
        body[i].impulse += impulse;
    }
    /// With the share s of the impulses the velocities are v + s dv: the work of the walls is a parabola over s.
    void take_back_gain(std::span<Rebounding> body) {
        Real a = 0, b = 0;
        for (std::size_t i = 0; i < body.size(); ++i) {
            const auto& one = body[i];
            a += one.impulse * (change(body, i) - one.before);
            b += one.impulse * Real(2) * (one.before - one.added);
        }
        if (!(a + b > Real(0))) return;
        const Real share = clamp(-b * inverse_or_zero(a), Real(0), Real(1));
        for (std::size_t i = 0; i < body.size(); ++i) push(body, i, (share - Real(1)) * body[i].impulse);
    }
    /// Friction of the blow, at the rims of balls. Each impulse takes energy.
    void rub(std::span<Rebounding> body) {
        for (std::size_t i = 0; i < body.size(); ++i) {
            const auto& row = row_of(body[i]);
            if (!(row.friction > Real(0)) || !(body[i].impulse > Real(0))) continue;
            const auto& surface = part_of(body[i]).origins[body[i].row].surface_displacement;
            const auto slip = rows_.slip_of(row, figures_.moved(i) - surface);
            const auto against = -direction(slip);
            const Real mass = rows_.mass_with_turns(row, figures_.mass_along(i, against));
            const Real impulse = min(norm(slip) * mass, row.friction * body[i].impulse);
            if (!(impulse > Real(0))) continue;
            figures_.push(i, against * impulse);
            rows_.turn(row, against * impulse);
        }
    }
    void note(const Rebounding& one) {
        auto& row = row_of(one);
        row.max = max(row.max, row.multiplier + one.impulse);
        part_of(one).origins[one.row].pushed += one.impulse;
    }
};

} // namespace sinew::detail

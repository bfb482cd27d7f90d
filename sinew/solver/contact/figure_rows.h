#pragma once

#include "sinew/solver/contact/crossing_sides.h"
#include "sinew/solver/contact/solid_rows.h"
#include "sinew/solver/contact/solids.h"

namespace sinew::detail {

/// Rows of contact between figures: nearest points, normals and gaps of the listed pairs.
template <int D, class Real> class FigureRows : SolidRows<D, Real> {
    using Base = SolidRows<D, Real>;
    using Base::add, Base::admit, Base::position, Base::share_of_deep, Base::take, Base::finish, Base::restore;
    using Base::set_thickness, Base::number_of, Base::slack_of;
    using Base::state_, Base::room_, Base::list_, Base::part_, Base::p_, Base::source_, Base::near_by_;
    using typename Base::ContactRowT;
    using typename Base::Origin;
    using typename Base::Vector;
    using Particle = ContactParticle<Real>;

  public:
    FigureRows(World<D, Real>& world, Solver<D, Real>& solver, ContactPart<D, Real>& part, Real h)
        : Base(world, solver, part, h) {}

    /// Adds, of all candidates, those near each other, and those whose contact lasts.
    void add_all(const Kernels<D, Real>& kernels) {
        const auto& list = room_.list;
        part_.near.resize(part_.last - part_.first);
        const auto count = kernels.near_pairs({.position = state_.position[0],
                                               .displacement = state_.displacement[0],
                                               .stride = state_.stride(),
                                               .mobility = state_.mobility,
                                               .p = list.near_p.data(),
                                               .a = list.near_a.data(),
                                               .b = list.near_b.data(),
                                               .size = list.near_size.data()},
                                              part_.first, part_.last, part_.near.data());
        auto next = part_.first;
        const auto add_lasting = [&](std::uint32_t end) {
            for (; next < end; ++next)
                if (const auto& kept = room_.multipliers[next]; kept.normal > Real(0) || kept.side != 0) add(next);
        };
        for (std::uint32_t i = 0; i < count; ++i) {
            add_lasting(part_.near[i].pair);
            add(part_.near[i]);
            ++next;
        }
        add_lasting(part_.last);
    }

  private:
    /// Depth from which crossing links are held as the figures answer, of both radii: less than `share_of_deep`, since
    /// they have no other rows beside.
    static constexpr Real share_of_crossing = Real(0.3);
    bool is_of_solid(std::uint32_t feature) const {
        if (room_.is_solid(feature)) return true;
        const auto& s = room_.segments[feature - room_.particles.size()];
        return s.side != 0 || s.edge != PolyhedronRoom::none;
    }
    Solids<D, Real> solids_{room_, state_};

    /// Adds the row of a pair whose nearest points are known.
    void add(const NearSegment<D, Real>& near) {
        const auto [first, second] = room_.list.candidates[near.pair];
        const auto count = room_.particles.size();
        const bool has_segment = first >= count;
        if (!(near.distance >= std::numeric_limits<Real>::min()) || second >= count ||
            (has_segment && is_of_solid(first)))
            return add(near.pair);
        source_ = near.pair;
        const bool acts = has_segment ? add(near, room_.particles[second], room_.segments[first - count])
                                      : add(near, room_.particles[first], room_.particles[second]);
        if (!acts) forget();
    }
    bool add(const NearSegment<D, Real>& near, const Particle& p, const Particle& other) {
        if (near.distance < p.radius + other.radius && are_nested(p, other)) return false;
        ContactRowT row;
        row.normal = Vector::map([&](int k) { return near.normal[k]; });
        row.gap = near.distance - p.radius - other.radius;
        take(row, p, other);
        return finish(row, near, near.approach, p, other, other.radius);
    }
    bool add(const NearSegment<D, Real>& near, const Particle& p, const ContactSegment& s) {
        const auto &end_a = room_.particles[s.number_a], &end_b = room_.particles[s.number_b];
        ContactRowT row;
        row.normal = Vector::map([&](int k) { return near.normal[k]; });
        Real distance = near.distance, approach = near.approach;
        const Real radius = min(end_a.radius, end_b.radius);
        if constexpr (D == 2)
            if (remember_side(row, near.left >= Real(0), near.t, distance, p.radius + radius)) approach = -approach;
        if constexpr (D == 3)
            if (remember_side(row, p, end_a, end_b, near.t, distance, p.radius + radius)) approach = -approach;
        row.gap = distance - p.radius - radius;
        take(row, p, end_a, end_b, near.t);
        return finish(row, near, approach, p, end_a, radius);
    }
    bool finish(ContactRowT& row, const NearSegment<D, Real>& near, Real approach, const Particle& p,
                const Particle& other, Real radius) {
        Origin origin;
        set_thickness(origin, p.radius + radius);
        return admit(row, origin, near.response, approach, restore(row, origin, p, other));
    }
    void add(std::uint32_t candidate) {
        source_ = candidate;
        const auto& pair = room_.list.candidates[candidate];
        const auto count = room_.particles.size();
        bool acts = false;
        if (pair.first < count)
            acts = add(room_.particles[pair.first], room_.particles[pair.second]);
        else if (room_.is_solid(pair.first))
            acts = this->add_on_face(room_.particles[pair.second], room_.solid(pair.first));
        else if (pair.second < count)
            acts = add(room_.particles[pair.second], room_.segments[pair.first - count]);
        else if constexpr (D == 3)
            acts = add(room_.segments[pair.first - count], room_.segments[pair.second - count]);
        if (!acts) forget();
    }

    // --- solids ------------------------------------------------------------------------------------------------------

    /// True for a corner of a solid inside another one: it leaves by a side, not away from a corner.
    bool are_nested(const Particle& a, const Particle& b) {
        if constexpr (D == 2) {
            const Real slack = slack_of(min(a.radius, b.radius));
            return solids_.contains(solids_.of(number_of(b)), state_.position_at(a.slot), slack) ||
                   solids_.contains(solids_.of(number_of(a)), state_.position_at(b.slot), slack);
        }
        return Base::are_of_nested(a, b);
    }

    // --- figures with each other -------------------------------------------------------------------------------------

    bool add(const Particle& a, const Particle& b) {
        const auto away = state_.position_at(a.slot) - state_.position_at(b.slot);
        ContactRowT row;
        Origin origin;
        row.normal = normal_of(away, Vector::axis(1));
        row.gap = norm(away) - a.radius - b.radius;
        if (row.gap < Real(0) && are_nested(a, b)) return false;
        set_thickness(origin, a.radius + b.radius);
        take(row, a, b);
        return finish(row, origin, a, b);
    }

    bool add(const Particle& p, const ContactSegment& s) {
        const auto &end_a = room_.particles[s.number_a], &end_b = room_.particles[s.number_b];
        const auto a = state_.position_at(end_a.slot), b = state_.position_at(end_b.slot),
                   x = state_.position_at(p.slot);
        const Real t = collide::nearest_parameter(a, b, x);
        const auto away = x - (a + (b - a) * t);
        const Real radius = min(end_a.radius, end_b.radius);
        ContactRowT row;
        Origin origin;
        Real distance = norm(away);
        const Real per = inverse_or_zero(distance);
        row.normal = per > Real(0) ? away * per : left_of(a, b);
        const bool is_nested = s.side != 0 && list_.is_nested(solids_.of(number_of(p)), s.first);
        if (s.side != 0 && (is_nested || (t > Real(0) && t < Real(1)))) {
            row.normal = left_of(a, b) * Real(s.side);
            distance = dot(row.normal, away);
            if (distance < -Real(2) * list_.widest && !is_nested) return false;
            if (distance < Real(0) && !solids_.is_way_out(number_of(p), x, s)) return false;
        } else if (s.side != 0 && distance < p.radius + radius && solids_.contains(s.first, x, slack_of(radius))) {
            return false; // a corner inside leaves by a side
        }
        if (!Base::is_around_edge(p, s, x, away, t)) return false;
        if constexpr (D == 2)
            if (s.side == 0)
                remember_side(row, dot(row.normal, side_of(a, b)) >= Real(0), t, distance, p.radius + radius);
        row.gap = distance - p.radius - radius;
        set_thickness(origin, p.radius + radius);
        take(row, p, end_a, end_b, t);
        return finish(row, origin, p, end_a);
    }

    bool add(const ContactSegment& s, const ContactSegment& t) {
        const auto &from = room_.particles[s.number_a], &other = room_.particles[t.number_a];
        const auto a = position(s.a), b = position(s.b), c = position(t.a), d = position(t.b);
        const auto at = collide::nearest_parameters(a, b, c, d);
        const bool inside = at.s > Real(0) && at.s < Real(1) && at.t > Real(0) && at.t < Real(1);
        if (!inside) return false; // rows of the ends
        const auto away = a + (b - a) * at.s - (c + (d - c) * at.t);
        ContactRowT row;
        Origin origin;
        row.normal = normal_of(away, across(b - a, d - c));
        const Real thickness = min(p_.radius[s.a], p_.radius[s.b]) + min(p_.radius[t.a], p_.radius[t.b]);
        Real distance = norm(away);
        if (s.edge == PolyhedronRoom::none && t.edge == PolyhedronRoom::none)
            remember_side(row, away, b - a, d - c, distance, thickness);
        else if (!Base::find_axis(s, t, away, row.normal, distance, thickness))
            return false;
        row.gap = distance - thickness;
        set_thickness(origin, thickness, share_of_crossing);
        origin.deep = max(origin.deep, Base::depth_at(s, t));
        take(row, {&from, &room_.particles[s.number_b], &other, &room_.particles[t.number_b]}, at.s, at.t);
        return finish(row, origin, from, other);
    }

    /// A particle pressed through the middle of a segment is pushed back, not through, as long as they touch. True if
    /// it is beyond.
    bool remember_side(ContactRowT& row, bool is_left, Real t, Real& distance, Real thickness) const {
        const bool is_pressed = t > Real(0) && t < Real(1) && distance <= thickness;
        const int present = is_left ? 1 : -1, before = room_.multipliers[source_].side;
        row.side = static_cast<signed char>(is_pressed && before != 0 ? before : present);
        if (row.side == present) return false;
        return turn_round(row, distance);
    }

    /// A particle of a line that crosses a link, or a link that does, and is pressed through it, is pushed back.
    bool remember_side(ContactRowT& row, const Particle& p, const Particle& end_a, const Particle& end_b, Real t,
                       Real& distance, Real thickness) {
        if (!p.in_segment || !(t > Real(0) && t < Real(1)) || distance > thickness) return false;
        const auto number = room_.list.candidates[source_].second;
        return remember_side(row, row.normal * distance, sides_of().direction_at(number),
                             state_.position_at(end_b.slot) - state_.position_at(end_a.slot), distance, thickness);
    }
    bool remember_side(ContactRowT& row, const Vector& away, const Vector& u, const Vector& v, Real& distance,
                       Real thickness) {
        if (distance > thickness) return false;
        const int present = CrossingSides<Real>::side_of(away, u, v);
        row.side = static_cast<signed char>(present == 0 ? 0 : sides_of().kept(source_, present));
        if (row.side == present) return false;
        return turn_round(row, distance);
    }
    static bool turn_round(ContactRowT& row, Real& distance) {
        row.normal = -row.normal;
        distance = -distance;
        return true;
    }
    CrossingSides<Real> sides_of() const { return {state_, room_}; }
    /// Sides stay for the pairs beside, until all rows are made.
    void forget() {
        auto& kept = room_.multipliers[source_];
        kept = D == 3 ? ContactMultiplier<D, Real>{.side = kept.side} : ContactMultiplier<D, Real>{};
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/contact/contact_room.h"

/// Rows of contact of a part at the start of a substep: nearest points, normals and gaps of all listed pairs, and of
/// particles with walls.
namespace sinew::detail {

template <int D, class Real> class RowBuilder {
  public:
    using Vector = Vec<D, Real>;
    using ContactRowT = ContactRow<D, Real>;
    using Origin = ContactOrigin<D, Real>;

    RowBuilder(World<D, Real>& world, Solver<D, Real>& solver, ContactPart<D, Real>& part, Real h, Real from_share,
               Real to_share)
        : world_(world), p_(world.particles), state_(solver.sweep_state), room_(contact_room(solver)), part_(part),
          touches_(solver.touches), h_(h), near_by_(room_.list.near_by), margin_(room_.list.margin), from_(from_share),
          to_(to_share) {}

    void run(const Kernels<D, Real>& kernels) {
        part_.rows.clear(), part_.origins.clear();
        part_.wall_keys.clear();
        part_.deep.clear();
        add_figures(kernels);
        part_.first_wall = part_.rows.size();
        for (const auto number : part_.near_planes) add_planes(room_.particles[number].row);
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            for (const auto number : part_.particles) add_collider_rows(room_.particles[number].row, i);
            for (const auto number : part_.segments) add_collider_row(room_.segments[number], i);
        }
    }
    /// Distance from which a wall is looked at beyond the radius, so that what rests on it is never out of touch.
    static Real reach(Real radius, Real gravity, Real h) { return Real(0.05) * radius + gravity * square(h) * Real(4); }

  private:
    using Particle = ContactParticle<Real>;
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    SweepState<D, Real>& state_;
    ContactRoom<D, Real>& room_;
    ContactPart<D, Real>& part_;
    const ColliderTouches<D, Real>& touches_;
    Real h_, near_by_, margin_, from_, to_;
    std::uint32_t source_ = 0;                       ///< the candidate
    static constexpr Real share_of_deep = Real(0.5); ///< of the radii

    Vector position(Row row) const { return state_.position_at(state_.slot_of[row]); }
    Vector displacement(Row row) const { return state_.displacement_at(state_.slot_of[row]); }
    std::uint32_t id(Row row) const { return p_.slots.slot_of(row); }

    /// Of all candidates those near each other, and those whose contact lasts.
    void add_figures(const Kernels<D, Real>& kernels) {
        const auto& list = room_.list;
        part_.near.resize(part_.last - part_.first);
        const auto count = kernels.near_pairs({.position = state_.position[0],
                                               .displacement = state_.displacement[0],
                                               .stride = state_.stride(),
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
            add_lasting(part_.near[i]);
            add(next++);
        }
        add_lasting(part_.last);
    }
    void add(std::uint32_t candidate) {
        source_ = candidate;
        const auto& pair = room_.list.candidates[candidate];
        const auto count = room_.particles.size();
        bool acts = false;
        if (pair.first < count)
            acts = add(room_.particles[pair.first], room_.particles[pair.second]);
        else if (pair.second < count)
            acts = add(room_.particles[pair.second], room_.segments[pair.first - count]);
        else if constexpr (D == 3)
            acts = add(room_.segments[pair.first - count], room_.segments[pair.second - count]);
        if (!acts) room_.multipliers[source_] = {};
    }

    // --- figures with each other -------------------------------------------------------------------------------------

    static Vector normal_of(const Vector& away, const Vector& otherwise) {
        const Real per = inverse_or_zero(norm(away));
        return per > Real(0) ? away * per : otherwise;
    }

    bool add(const Particle& a, const Particle& b) {
        const auto away = state_.position_at(a.slot) - state_.position_at(b.slot);
        ContactRowT row;
        Origin origin;
        row.normal = normal_of(away, Vector::axis(1));
        const Real distance = norm(away), cover = max(a.cover, b.cover);
        row.gap = min(distance - a.radius - b.radius, distance - cover);
        origin.deep = share_of_deep * (a.radius + b.radius);
        take(row, a.slot, Real(1));
        take(row, b.slot, Real(-1));
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
        if (s.side != 0 && t > Real(0) && t < Real(1)) {
            row.normal = left_of(a, b) * Real(s.side);
            distance = dot(row.normal, away);
            if (distance < -Real(2) * room_.list.widest) return false;
            if (distance < Real(0) && !is_nearest_side(x, s, distance)) return false;
        }
        if constexpr (D == 2)
            if (s.side == 0) remember_side(row, a, b, t, distance);
        row.gap = min(distance - p.radius - radius, distance - p.cover);
        origin.deep = share_of_deep * (p.radius + radius);
        take(row, p.slot, Real(1));
        if (t < Real(1)) take(row, end_a.slot, t - Real(1));
        if (t > Real(0)) take(row, end_b.slot, -t);
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
        row.gap = norm(away) - min(p_.radius[s.a], p_.radius[s.b]) - min(p_.radius[t.a], p_.radius[t.b]);
        take(row, from.slot, Real(1) - at.s);
        take(row, room_.particles[s.number_b].slot, at.s);
        take(row, other.slot, at.t - Real(1));
        take(row, room_.particles[t.number_b].slot, -at.t);
        return finish(row, origin, from, other);
    }

    /// A particle pressed through the middle of a segment is pushed back, not through.
    void remember_side(ContactRowT& row, const Vector& a, const Vector& b, Real t, Real& distance) {
        const bool is_left = dot(row.normal, side_of(a, b)) >= Real(0), is_between_ends = t > Real(0) && t < Real(1);
        const int present = is_left ? 1 : -1, before = room_.multipliers[source_].side;
        row.side = static_cast<signed char>(is_between_ends && before != 0 ? before : present);
        if (row.side == present || !is_between_ends) return;
        row.normal = -row.normal;
        distance = -distance;
    }

    /// Vector to the left of a segment.
    static Vector side_of(const Vector& a, const Vector& b) {
        if constexpr (D == 2)
            return perpendicular(b - a);
        else
            return across(b - a, absolute((b - a)[0]) < absolute((b - a)[1]) ? Vector::axis(0) : Vector::axis(1));
    }
    static Vector left_of(const Vector& a, const Vector& b) { return direction(side_of(a, b)); }
    static Vector across(const Vector& u, const Vector& v) {
        if constexpr (D == 3)
            return normal_of(cross(u, v), Vector::axis(1));
        else
            return normal_of(perpendicular(u), Vector::axis(1));
    }

    /// True if no other side of the solid is nearer to a point inside.
    bool is_nearest_side(const Vector& x, const ContactSegment& s, Real distance) const {
        for (auto i = s.first; i < s.first + s.count; ++i) {
            const auto& other = room_.segments[i];
            const auto a = position(other.a);
            if (dot(left_of(a, position(other.b)) * Real(other.side), x - a) > distance) return false;
        }
        return true;
    }

    bool finish(ContactRowT& row, Origin& origin, const Particle& first, const Particle& second) {
        row.friction = min(first.friction, second.friction);
        const auto& kept = room_.multipliers[source_];
        row.multiplier = kept.normal, row.tangent = kept.tangent;
        origin.source = source_;
        const Real slack = row.multiplier > Real(0) ? near_by_ + margin_ : near_by_;
        return add(row, origin, slack);
    }

    // --- walls -------------------------------------------------------------------------------------------------------

    Real reach(Row row) const { return reach(p_.radius[row], norm(state_.gravity), h_); }

    void add_planes(Row p) {
        if (!(p_.mobility[p] > Real(0))) return;
        const auto from = position(p), to = from + displacement(p);
        for (std::uint32_t i = 0; i < world_.bounds.size(); ++i) {
            const auto& plane = world_.bounds[i];
            const Real low = min(dot(plane.normal, from), dot(plane.normal, to)) - plane.offset - p_.radius[p];
            if (low > reach(p)) continue;
            ContactRowT row;
            Origin origin;
            ContactKey key{.particle = {id(p), ContactKey::none, ContactKey::none, ContactKey::none},
                           .collider = plane_bit | i};
            row.normal = plane.normal;
            row.gap = dot(plane.normal, from) - plane.offset - p_.radius[p];
            origin.deep = share_of_deep * p_.radius[p];
            row.friction = plane.friction, origin.restitution = plane.restitution;
            take(row, state_.slot_of[p], Real(1));
            add(row, origin, key);
        }
    }
    static constexpr std::uint32_t plane_bit = std::uint32_t(1) << 31U;

    void add_collider_rows(Row p, std::uint32_t index) {
        if (!(p_.mobility[p] > Real(0))) return;
        const auto from = position(p), to = from + displacement(p);
        const auto& collider = world_.colliders[index];
        const Real radius = p_.radius[p], within = radius + reach(p);
        collide::BoundingBox<D, Real> near;
        near.include(from);
        near.include(to);
        if (collider.is_sensor || !touches_.boxes[index].overlaps(near.grown(within)) ||
            !touch(collider.filter, filter_of(world_, p)))
            return;
        const collide::MovingCollider<D, Real> moving(collider, from_, to_);
        moving.contacts(from, to, within, [&](const auto& contact) {
            const auto& surface = contact.surface;
            ContactRowT row;
            Origin origin;
            ContactKey key{.particle = {id(p), ContactKey::none, ContactKey::none, ContactKey::none},
                           .collider = world_.collider_slots.slot_of(index),
                           .feature = part_of(collider, surface.feature)};
            origin.collider = index;
            row.normal = surface.normal;
            origin.surface_displacement = contact.surface_displacement;
            row.gap = dot(surface.normal, from - surface.point + contact.surface_displacement) - radius;
            origin.deep = share_of_deep * radius;
            row.friction = collider.friction, origin.restitution = collider.restitution;
            take(row, state_.slot_of[p], Real(1));
            add(row, origin, key);
        });
    }
    /// A link over an edge or a round shape touches it between its ends, which have rows of their own.
    void add_collider_row(const ContactSegment& s, std::uint32_t index) {
        const auto& collider = world_.colliders[index];
        const auto a = position(s.a), b = position(s.b);
        const Real radius = min(p_.radius[s.a], p_.radius[s.b]);
        const Real within = radius + reach(s.a) + max(norm(displacement(s.a)), norm(displacement(s.b)));
        collide::BoundingBox<D, Real> near;
        near.include(a);
        near.include(b);
        if (collider.is_sensor || collider.one_way != Vector{} || !touches_.boxes[index].overlaps(near.grown(within)) ||
            !touch(collider.filter, filter_of(world_, s.a)))
            return;
        const auto before = collider.pose_at(from_), after = collider.pose_at(to_);
        const auto found = collide::nearest_to_segment(collider.shape, before, a, b, within);
        if (!found || !(found->t > Real(0)) || !(found->t < Real(1))) return;
        ContactRowT row;
        Origin origin;
        ContactKey key{.particle = {id(s.a), id(s.b), ContactKey::none, ContactKey::none},
                       .collider = world_.collider_slots.slot_of(index)};
        origin.collider = index;
        row.normal = found->surface.normal;
        origin.surface_displacement = after.to_world(before.to_local(found->surface.point)) - found->surface.point;
        row.gap = found->surface.distance - radius;
        row.friction = collider.friction, origin.restitution = collider.restitution;
        take(row, state_.slot_of[s.a], Real(1) - found->t);
        take(row, state_.slot_of[s.b], found->t);
        add(row, origin, key);
    }

    /// Lasting number of a contact: the part of a surface; a convex shape has one contact with a sphere.
    static std::uint32_t part_of(const collide::Collider<D, Real>& collider, std::uint32_t feature) {
        return std::visit(
            [&]<class Held>(const Held&) -> std::uint32_t {
                if constexpr (!collide::IsSurface<Held>)
                    return 0;
                else
                    return D == 2 ? feature / 3 : feature;
            },
            collider.shape);
    }

    void add(ContactRowT& row, Origin& origin, const ContactKey& key) {
        if (const auto* kept = find_kept(key)) row.multiplier = kept->multiplier, row.tangent = kept->friction;
        origin.source = std::uint32_t(part_.wall_keys.size());
        const bool acts = row.multiplier > Real(0);
        if (add(row, origin, acts ? std::numeric_limits<Real>::max() : norm(state_.gravity) * square(h_) * Real(4)))
            part_.wall_keys.push_back(key);
    }
    const KeptContact<D, Real>* find_kept(const ContactKey& key) const {
        const auto& kept = room_.kept_at_walls;
        const auto found = std::lower_bound(kept.begin(), kept.end(), key,
                                            [](const auto& contact, const ContactKey& k) { return contact.key < k; });
        return found != kept.end() && found->key == key ? &*found : nullptr;
    }

    // --- all ---------------------------------------------------------------------------------------------------------

    static void take(ContactRowT& row, Row slot, Real weight) {
        row.slot[row.members] = slot;
        row.weight[row.members++] = weight;
    }

    /// Adds a row that may touch within the substep: gap <= 2 approach + slack. True if so.
    bool add(ContactRowT& row, Origin& origin, Real slack) {
        Real response = 0, approach = dot(row.normal, origin.surface_displacement);
        for (int i = 0; i < row.members; ++i) {
            const auto slot = row.slot[std::size_t(i)];
            const Real weight = row.weight[std::size_t(i)];
            response += square(weight) * state_.mobility[slot];
            approach -= weight * dot(row.normal, state_.displacement_at(slot));
        }
        if (response == Real(0) || row.gap > Real(2) * absolute(approach) + slack) return false;
        for (int i = 0; i < row.members; ++i) row.keeps = row.keeps && room_.is_exact[row.slot[std::size_t(i)]];
        for (std::size_t i = row.members; i < row.slot.size(); ++i) row.slot[i] = row.slot[0]; // of no weight
        row.mass = Real(1) / response;
        origin.approach = approach;
        row.tangent -= row.normal * dot(row.normal, row.tangent);
        part_.rows.push_back(row);
        part_.origins.push_back(origin);
        if (row.keeps && row.gap < Real(-0.5) * origin.deep) part_.deep.push_back(std::uint32_t(part_.rows.size() - 1));
        return true;
    }
};

} // namespace sinew::detail

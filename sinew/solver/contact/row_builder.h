#pragma once

#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/contact/contact_room.h"

/// Rows of contact at the start of a substep: nearest points, normals and gaps of all listed pairs, and of particles
/// with walls.
namespace sinew::detail {

template <int D, class Real> class RowBuilder {
  public:
    using Vector = Vec<D, Real>;
    using ContactRowT = ContactRow<D, Real>;

    RowBuilder(World<D, Real>& world, Solver<D, Real>& solver, Real h, Real from_share, Real to_share)
        : world_(world), p_(world.particles), state_(solver.sweep_state), room_(contact_room(solver)),
          touches_(solver.touches), h_(h), from_(from_share), to_(to_share) {}

    void run() {
        room_.rows.clear();
        for (const auto& pair : room_.candidates) add(pair);
        for (const Row row : room_.particles)
            if (room_.by_rows[state_.slot_of[row]]) add_walls(row);
        for (const auto& segment : room_.segments)
            for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) add_collider_row(segment, i);
    }

  private:
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    SweepState<D, Real>& state_;
    ContactRoom<D, Real>& room_;
    const ColliderTouches<D, Real>& touches_;
    Real h_, from_, to_;

    Vector place(Row row) const { return state_.place_at(state_.slot_of[row]); }
    Vector move(Row row) const { return state_.move_at(state_.slot_of[row]); }
    std::uint32_t id(Row row) const { return p_.slots.slot_of(row); }

    void add(const ContactCandidate& pair) {
        const auto count = room_.particles.size();
        if (pair.first >= count) return add(room_.segments[pair.first - count], room_.segments[pair.second - count]);
        const Row row = room_.particles[pair.first];
        if (pair.second >= count) return add(row, room_.segments[pair.second - count]);
        add(row, room_.particles[pair.second]);
    }

    // --- figures with each other -------------------------------------------------------------------------------------

    static Vector normal_of(const Vector& away, const Vector& otherwise) {
        const Real per = inverse_or_zero(norm(away));
        return per > Real(0) ? away * per : otherwise;
    }

    void add(Row a, Row b) {
        const auto away = place(a) - place(b);
        ContactRowT row;
        row.key.particle = {id(a), ContactKey::none, id(b), ContactKey::none};
        row.normal = normal_of(away, Vector::axis(1));
        const Real cover = maximum(room_.cover_of(a), room_.cover_of(b));
        row.gap = minimum(norm(away) - p_.radius[a] - p_.radius[b], norm(away) - cover);
        take(row, a, Real(1));
        take(row, b, Real(-1));
        finish(row, a, b);
    }

    void add(Row p, const ContactSegment& s) {
        const auto a = place(s.a), b = place(s.b), x = place(p);
        const Real t = collide::nearest_parameter(a, b, x);
        const auto away = x - (a + (b - a) * t);
        ContactRowT row;
        row.key.particle = {id(p), ContactKey::none, id(s.a), id(s.b)};
        row.normal = normal_of(away, side_of(a, b));
        Real distance = norm(away);
        if (s.side != 0 && t > Real(0) && t < Real(1)) {
            row.normal = side_of(a, b) * Real(s.side);
            distance = dot(row.normal, away);
            if (distance < Real(0) && !is_nearest_side(x, s, distance)) return;
        }
        row.gap =
            minimum(distance - p_.radius[p] - minimum(p_.radius[s.a], p_.radius[s.b]), distance - room_.cover_of(p));
        take(row, p, Real(1));
        if (t < Real(1)) take(row, s.a, t - Real(1));
        if (t > Real(0)) take(row, s.b, -t);
        finish(row, p, s.a);
    }

    void add(const ContactSegment& s, const ContactSegment& t) {
        const auto a = place(s.a), b = place(s.b), c = place(t.a), d = place(t.b);
        const auto at = collide::nearest_parameters(a, b, c, d);
        const bool inside = at.s > Real(0) && at.s < Real(1) && at.t > Real(0) && at.t < Real(1);
        if (!inside) return; // rows of the ends
        const auto away = a + (b - a) * at.s - (c + (d - c) * at.t);
        ContactRowT row;
        row.key.particle = {id(s.a), id(s.b), id(t.a), id(t.b)};
        row.normal = normal_of(away, across(b - a, d - c));
        row.gap = norm(away) - minimum(p_.radius[s.a], p_.radius[s.b]) - minimum(p_.radius[t.a], p_.radius[t.b]);
        take(row, s.a, Real(1) - at.s);
        take(row, s.b, at.s);
        take(row, t.a, at.t - Real(1));
        take(row, t.b, -at.t);
        finish(row, s.a, t.a);
    }

    static Vector side_of(const Vector& a, const Vector& b) {
        if constexpr (D == 2)
            return direction(perpendicular(b - a));
        else
            return across(b - a, absolute((b - a)[0]) < absolute((b - a)[1]) ? Vector::axis(0) : Vector::axis(1));
    }
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
            const auto a = place(other.a);
            if (dot(side_of(a, place(other.b)) * Real(other.side), x - a) > distance) return false;
        }
        return true;
    }

    void finish(ContactRowT& row, Row first, Row second) {
        row.friction = friction_between(first, second);
        add(row);
    }
    Real friction_between(Row a, Row b) const {
        return Real(minimum(world_.figures[p_.figure[a]].friction, world_.figures[p_.figure[b]].friction));
    }

    // --- walls -------------------------------------------------------------------------------------------------------

    /// Distance from which a wall is looked at beyond the radius, so that what rests on it is never out of touch.
    Real reach(Row row) const { return Real(0.05) * p_.radius[row] + norm(state_.gravity) * square(h_) * Real(4); }

    void add_walls(Row p) {
        if (!(p_.mobility[p] > Real(0))) return;
        const auto from = place(p), to = from + move(p);
        for (std::uint32_t i = 0; i < world_.bounds.size(); ++i) {
            const auto& plane = world_.bounds[i];
            const Real low = minimum(dot(plane.normal, from), dot(plane.normal, to)) - plane.offset - p_.radius[p];
            if (low > reach(p)) continue;
            ContactRowT row;
            row.key.particle = {id(p), ContactKey::none, ContactKey::none, ContactKey::none};
            row.key.collider = plane_bit | i;
            row.normal = plane.normal;
            row.gap = dot(plane.normal, from) - plane.offset - p_.radius[p];
            row.friction = plane.friction, row.restitution = plane.restitution;
            take(row, p, Real(1));
            add(row);
        }
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) add_collider_rows(p, i, from, to);
    }
    static constexpr std::uint32_t plane_bit = std::uint32_t(1) << 31U;

    void add_collider_rows(Row p, std::uint32_t index, const Vector& from, const Vector& to) {
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
            row.key.particle = {id(p), ContactKey::none, ContactKey::none, ContactKey::none};
            row.key.collider = world_.collider_slots.slot_of(index);
            row.key.feature = part_of(collider, surface.feature);
            row.collider = index;
            row.normal = surface.normal;
            row.surface_move = contact.surface_move;
            row.gap = dot(surface.normal, from - surface.point + contact.surface_move) - radius;
            row.friction = collider.friction, row.restitution = collider.restitution;
            take(row, p, Real(1));
            add(row);
        });
    }
    /// A link over an edge or a round shape touches it between its ends, which have rows of their own.
    void add_collider_row(const ContactSegment& s, std::uint32_t index) {
        const auto& collider = world_.colliders[index];
        const auto a = place(s.a), b = place(s.b);
        const Real radius = minimum(p_.radius[s.a], p_.radius[s.b]);
        const Real within = radius + reach(s.a) + maximum(norm(move(s.a)), norm(move(s.b)));
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
        row.key.particle = {id(s.a), id(s.b), ContactKey::none, ContactKey::none};
        row.key.collider = world_.collider_slots.slot_of(index);
        row.collider = index;
        row.normal = found->surface.normal;
        row.surface_move = after.to_world(before.to_local(found->surface.point)) - found->surface.point;
        row.gap = found->surface.distance - radius;
        row.friction = collider.friction, row.restitution = collider.restitution;
        take(row, s.a, Real(1) - found->t);
        take(row, s.b, found->t);
        add(row);
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

    // --- all
    // -----------------------------------------------------------------------------------------------------------

    void take(ContactRowT& row, Row particle, Real weight) const {
        row.slot[std::size_t(row.members)] = state_.slot_of[particle];
        row.weight[std::size_t(row.members++)] = weight;
    }

    /// Adds a row that may touch within the substep.
    void add(ContactRowT& row) {
        Real response = 0, approach = dot(row.normal, row.surface_move);
        for (int i = 0; i < row.members; ++i) {
            const auto slot = row.slot[std::size_t(i)];
            const Real weight = row.weight[std::size_t(i)];
            response += square(weight) * state_.mobility[slot];
            approach -= weight * dot(row.normal, state_.move_at(slot));
            row.keeps = row.keeps && room_.is_exact[slot];
        }
        if (response == Real(0)) return;
        row.mass = Real(1) / response;
        row.approach = approach;
        const auto kept = find_kept(row.key);
        if (kept) row.multiplier = kept->multiplier, row.tangent = kept->friction;
        if (!(row.multiplier > Real(0)) && row.gap > Real(2) * absolute(approach) + near_by(row)) return;
        row.tangent -= row.normal * dot(row.normal, row.tangent);
        room_.rows.push_back(row);
    }
    Real near_by(const ContactRowT&) const { return norm(state_.gravity) * square(h_) * Real(4); }

    const KeptContact<D, Real>* find_kept(const ContactKey& key) const {
        const auto& kept = world_.contacts.kept;
        const auto found = std::lower_bound(kept.begin(), kept.end(), key,
                                            [](const auto& contact, const ContactKey& k) { return contact.key < k; });
        return found != kept.end() && found->key == key ? &*found : nullptr;
    }
};

} // namespace sinew::detail

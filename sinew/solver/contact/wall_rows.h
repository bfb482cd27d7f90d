#pragma once

#include "sinew/collide/moving_collider.h"
#include "sinew/solver/contact/collider_sweep.h"
#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/contact/row_writer.h"
#include "sinew/solver/contact/softness.h"

namespace sinew::detail {

/// Rows of contact with planes and colliders.
template <int D, class Real> class WallRows : protected RowWriter<D, Real> {
  protected:
    using Base = RowWriter<D, Real>;
    using Base::add, Base::admit, Base::is_admitted, Base::take, Base::position, Base::share_of_deep;
    using Base::world_, Base::h_, Base::displacement, Base::state_, Base::room_, Base::part_, Base::p_;
    using typename Base::ContactRowT;
    using typename Base::Origin;
    using typename Base::Vector;

  public:
    /// `from`, `to`: shares of the step at the ends of the substep.
    WallRows(World<D, Real>& world, Solver<D, Real>& solver, ContactPart<D, Real>& part, Real h, Real from, Real to)
        : Base(world, solver, part, h), touches_(solver.touches), from_(from), to_(to) {}

    void add_all() {
        for (const auto number : part_.near_planes) add_planes(room_.particles[number].row);
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            for (const auto number : part_.particles) add_collider_rows(room_.particles[number].row, i);
            for (const auto number : part_.segments) add_collider_row(room_.segments[number], i);
        }
    }
    /// Distance from which a wall is looked at beyond the radius, so that resting particles are never out of touch.
    static Real margin(Real radius, Real gravity, Real h) {
        return Real(0.05) * radius + gravity * square(h) * Real(4);
    }

  protected:
    using CoverT = collide::Cover<D, Real, Real>;
    const ColliderTouches<D, Real>& touches_;
    Real from_, to_;

    template <class Wall> void rub(ContactRowT& row, Origin& origin, Row p, const Wall& wall) const {
        const auto surface = surface_between(world_, p, wall);
        row.friction = surface.friction, origin.restitution = surface.restitution;
    }
    std::uint32_t id(Row row) const { return p_.handles.index_of(row); }
    Real margin(Row row) const { return margin(p_.radius[row], norm(state_.gravity), h_); }

    void add_planes(Row p) {
        if (!(p_.mobility[p] > Real(0))) return;
        const auto from = position(p), to = from + displacement(p);
        for (std::uint32_t i = 0; i < world_.bounds.size(); ++i) {
            const auto& plane = world_.bounds[i];
            const Real low = min(dot(plane.normal, from), dot(plane.normal, to)) - plane.offset - p_.radius[p];
            if (low > margin(p)) continue;
            ContactRowT row;
            Origin origin;
            ContactKey key{.particle = {id(p), ContactKey::none, ContactKey::none, ContactKey::none},
                           .collider = plane_bit | i};
            row.normal = plane.normal;
            row.gap = dot(plane.normal, from) - plane.offset - p_.radius[p];
            if (lists_planes(world_)) origin.collider = std::uint32_t(world_.colliders.size()) + i;
            origin.deep = share_of_deep * p_.radius[p];
            rub(row, origin, p, plane);
            take(row, state_.slot_of[p], Real(1));
            add(row, origin, key);
        }
    }

    void add_collider_rows(Row p, std::uint32_t index) {
        if (!(p_.mobility[p] > Real(0))) return;
        const auto from = position(p), to = from + displacement(p);
        const auto& collider = world_.colliders[index];
        const Real radius = p_.radius[p], within = radius + margin(p);
        collide::BoundingBox<D, Real> near;
        near.include(from);
        near.include(to);
        if (collider.is_sensor || !touches_.boxes[index].overlaps(near.grown(within)) ||
            !touch(collider.filter, filter_of(world_, p)))
            return;
        const CoverT cover(world_.colliders, touches_.boxes, to_, filter_of(world_, p));
        const collide::MovingCollider<D, Real> moving(collider, from_, to_, h_, cover);
        moving.contacts(from, to, radius, margin(p), [&](const auto& contact) {
            const auto& surface = contact.surface;
            ContactRowT row;
            Origin origin;
            ContactKey key{.particle = {id(p), ContactKey::none, ContactKey::none, ContactKey::none},
                           .collider = world_.collider_handles.index_of(index),
                           .feature = part_of(collider, surface.feature)};
            if (!contact.begins_in_front && !was_held(key)) return;
            origin.collider = index, origin.is_one_way = collider.one_way != Vector{};
            row.normal = surface.normal;
            origin.surface_displacement = contact.surface_displacement;
            row.gap = dot(surface.normal, from - surface.point + contact.surface_displacement) - radius;
            origin.deep = share_of_deep * radius;
            rub(row, origin, p, collider);
            take(row, state_.slot_of[p], Real(1));
            add(row, origin, key);
        });
    }
    /// A link over an edge or a round shape touches it between its ends, which have rows of their own.
    void add_collider_row(const ContactSegment& s, std::uint32_t index) {
        const auto& collider = world_.colliders[index];
        const auto a = position(s.a), b = position(s.b);
        const Real radius = min(p_.radius[s.a], p_.radius[s.b]);
        const Real within = radius + margin(s.a) + max(norm(displacement(s.a)), norm(displacement(s.b)));
        collide::BoundingBox<D, Real> near;
        near.include(a);
        near.include(b);
        if (!touches_.boxes[index].overlaps(near.grown(within)) || !touch(collider.filter, filter_of(world_, s.a)))
            return;
        const auto before = collider.pose_at(from_);
        auto found = collide::nearest_to_segment(collider.shape, before, a, b, within);
        if (!found) return;
        if (!collider.is_sensor) {
            const auto surface = exposed(s, collider, before, found->surface);
            if (!surface) return;
            found->surface = *surface;
            if (add_rows_over_face(s, index, before, *found)) return;
        }
        if (is_between_ends(found->t)) add_link_row(s, index, *found, 0);
    }
    /// Ends have rows of their own. A row a rounding error beside a pinned end would push with the inverse of that
    /// error.
    static bool is_between_ends(Real t) {
        constexpr Real end = Real(1e-3);
        return t > end && t < Real(1) - end;
    }
    /// Part of the contact of a link with a solid that no other collider covers.
    std::optional<collide::SurfacePoint<D, Real>> exposed(const ContactSegment& s,
                                                          const collide::Collider<D, Real>& collider,
                                                          const collide::Pose<D, Real>& pose,
                                                          const collide::SurfacePoint<D, Real>& surface) const {
        const CoverT cover(world_.colliders, touches_.boxes, from_, filter_of(world_, s.a));
        const Real radius = min(p_.radius[s.a], p_.radius[s.b]);
        const collide::SurfacePoint<D, Real> local{pose.to_local(surface.point), pose.turn_back(surface.normal),
                                                   surface.distance, surface.feature};
        const auto left = std::visit(
            [&](const auto& shape) {
                return cover.exposed(collider, shape, pose, local, {radius, Real(0)});
            },
            collider.shape);
        return left ? std::optional(collide::to_world(pose, *left)) : std::nullopt;
    }
    /// A link along a flat face of a solid touches it at both ends of the part above it, across the link; ends of the
    /// link have rows of their own. False for a link above a corner, or another shape.
    bool add_rows_over_face(const ContactSegment& s, std::uint32_t index, const collide::Pose<D, Real>& pose,
                            const collide::SegmentApproach<D, Real>& found) {
        const auto a = position(s.a), b = position(s.b);
        const auto over = std::visit(
            [&]<class Held>(const Held& shape) -> std::optional<collide::SegmentOverFace<D, Real>> {
                if constexpr (requires { shape.over_face(a, b, a); })
                    return shape.over_face(pose.to_local(a), pose.to_local(b), pose.turn_back(found.surface.normal));
                else
                    return std::nullopt;
            },
            world_.colliders[index].shape);
        if (!over || !(over->low <= over->high)) return false;
        const auto face = pose.turn(over->normal), along = direction(b - a);
        const auto normal = direction(face - along * dot(face, along));
        constexpr Real flat = Real(0.9); // cosine of 26 degrees: a steeper link touches at one point
        if (dot(face, normal) < flat) return false;
        for (const Real t : {over->low, over->high}) {
            const auto point = a + (b - a) * t;
            const Real height = dot(face, point - pose.position) - over->offset;
            if (is_between_ends(t))
                add_link_row(s, index, {t, {point - face * height, normal, height * dot(face, normal), 0}},
                             t == over->low ? 0 : 1);
        }
        return true;
    }
    /// Row of the point t of a link, with a number among those of the link and the collider.
    void add_link_row(const ContactSegment& s, std::uint32_t index, const collide::SegmentApproach<D, Real>& found,
                      std::uint32_t number) {
        const auto& collider = world_.colliders[index];
        const auto before = collider.pose_at(from_), after = collider.pose_at(to_);
        ContactRowT row;
        Origin origin;
        const ContactKey key{.particle = {id(s.a), id(s.b), ContactKey::none, ContactKey::none},
                             .collider = world_.collider_handles.index_of(index),
                             .feature = number};
        origin.collider = index;
        row.normal = found.surface.normal;
        origin.surface_displacement = after.to_world(before.to_local(found.surface.point)) - found.surface.point +
                                      collider.belt_velocity(after, row.normal) * h_;
        row.gap = found.surface.distance - min(p_.radius[s.a], p_.radius[s.b]);
        rub(row, origin, s.a, collider);
        take(row, state_.slot_of[s.a], Real(1) - found.t);
        take(row, state_.slot_of[s.b], found.t);
        origin.is_one_way = collider.one_way != Vector{};
        if (origin.is_one_way && !is_held_one_way(s, row, origin, key)) return;
        if (collider.is_sensor) {
            if (is_admitted(row, origin)) sense(row, origin);
            return;
        }
        add(row, origin, key);
    }
    bool is_held_one_way(const ContactSegment& s, const ContactRowT& row, const Origin& origin,
                         const ContactKey& key) const {
        const auto& collider = world_.colliders[origin.collider];
        if (!collider.is_solid_along(collider.pose_at(from_).turn_back(row.normal))) return false;
        const auto moved = displacement(s.a) * row.weight[0] + displacement(s.b) * row.weight[1];
        const Real radius = min(p_.radius[s.a], p_.radius[s.b]);
        return was_held(key) ||
               collide::comes_from_outside(row.gap + radius, dot(row.normal, moved - origin.surface_displacement),
                                           radius, norm(moved), max(norm(position(s.a)), norm(position(s.b))));
    }
    void sense(ContactRowT& row, const Origin& origin) {
        for (std::size_t i = row.members; i < row.slot.size(); ++i) row.slot[i] = row.slot[0]; // of no weight
        part_.sensed.push_back(row);
        part_.sensed_origins.push_back(origin);
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
        if (room_.is_buried_at(row.slot[0])) row.gap = max(row.gap, -way_out(p_.radius[state_.row_of[row.slot[0]]]));
        const bool acts = row.multiplier > Real(0);
        if (!add(row, origin, acts ? std::numeric_limits<Real>::max() : norm(state_.gravity) * square(h_) * Real(4)))
            return;
        part_.wall_keys.push_back(key);
        // A hand may pull a limb into a wall within a single substep.
        const auto number = std::uint32_t(part_.rows.size() - 1);
        if (row.keeps && (part_.deep.empty() || part_.deep.back() != number)) part_.deep.push_back(number);
    }
    /// Depth that rows see of a figure which hangs on a particle behind a wall: there may be no way out, so all of it
    /// comes out as slowly as from a sixteenth of its radius.
    Real way_out(Real radius) const {
        const Real depth = radius / Real(16);
        return (depth - depth_left(depth, norm(state_.gravity), h_)) / Softness<Real>::contact().rate;
    }
    /// True for features that the collider, or a neighbouring part of it, held in the last substep: contacts give a
    /// little, so a one-way collider cannot tell by their place.
    bool was_held(ContactKey key) const {
        key.feature = 0;
        const auto found = first_kept(key);
        return found != room_.kept_at_walls.end() && found->key.particle == key.particle &&
               found->key.collider == key.collider;
    }
    auto first_kept(const ContactKey& key) const {
        const auto& kept = room_.kept_at_walls;
        return std::lower_bound(kept.begin(), kept.end(), key,
                                [](const auto& contact, const ContactKey& k) { return contact.key < k; });
    }
    const KeptContact<D, Real>* find_kept(const ContactKey& key) const {
        const auto found = first_kept(key);
        return found != room_.kept_at_walls.end() && found->key == key ? &*found : nullptr;
    }
};

} // namespace sinew::detail

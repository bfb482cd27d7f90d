#pragma once

#include "sinew/collide/moving_collider.h"
#include "sinew/solver/contact/collider_sweep.h"

namespace sinew::detail {

/// Last look at the displacements of a substep: no middle of a particle passes the surface of a collider. Rows of
/// contact keep out what was predicted to pass; links that are made exact afterwards may press a limb through a wall
/// thinner than the correction, and a row of the next substep would then keep it behind.
template <int D, class Real> class WallGuard {
    using Vector = Vec<D, Real>;

  public:
    /// `from`, `to`: shares of the step at the ends of the substep, of length `h`.
    WallGuard(World<D, Real>& world, Solver<D, Real>& solver, Real h, Real from, Real to)
        : world_(world), state_(solver.sweep_state), touches_(solver.touches), contacts_(*solver.contacts),
          filter_(solver.options.contact_filter), h_(h), from_(from), to_(to) {}

    void hold() {
        constexpr int rounds = 3; // out of a corner
        if (world_.colliders.empty()) return;
        for (const auto& particle : contacts_.particles)
            if (state_.mobility[state_.slot_of[particle.row]] > Real(0) && !is_buried(particle.row))
                for (int i = 0; i < rounds && hold(particle.row); ++i) {
                }
    }

  private:
    static constexpr Real share_kept = Real(0.25); ///< of the radius, between middle and surface
    World<D, Real>& world_;
    SweepState<D, Real>& state_;
    const ColliderTouches<D, Real>& touches_;
    const ContactRoom<D, Real>& contacts_;
    const ContactFilter& filter_;
    Real h_, from_, to_;

    /// A figure that hangs on a particle behind a wall may have no way out of it.
    bool is_buried(Row row) const {
        const auto component = contacts_.projector.links().component_of[state_.slot_of[row]];
        return component != RigidLinks<D, Real>::none && contacts_.is_buried[component] != 0;
    }
    /// True if a collider has cut the displacement.
    bool hold(Row row) {
        const auto moved = state_.displacement_at(state_.slot_of[row]);
        const bool is_fast = dot(moved, moved) > square(share_kept * world_.particles.radius[row]);
        bool any = false;
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            const auto& collider = world_.colliders[i];
            // Rows, which last from substep to substep, keep out what moves less.
            if ((is_fast || !collider.is_at_rest()) && !collider.is_sensor && collider.one_way == Vector{} &&
                touch(collider.filter, filter_of(world_, row)))
                any = hold(row, i) || any;
        }
        return any;
    }
    bool hold(Row row, std::uint32_t index) {
        const auto& collider = world_.colliders[index];
        const Row slot = state_.slot_of[row];
        const auto begun = state_.position_at(slot), ended = begun + state_.displacement_at(slot);
        Real kept = share_kept * world_.particles.radius[row];
        collide::BoundingBox<D, Real> way;
        way.include(begun);
        way.include(ended);
        if (!touches_.boxes[index].overlaps(way.grown(kept))) return false;
        // The sphere that is kept out begins in front of the surface; a middle inside is left to the rows.
        if (const auto near = collide::nearest(collider.shape, collider.pose_at(from_), begun, Real(2) * kept))
            kept = min(kept, Real(0.5) * near->distance);
        if (!(kept > Real(0))) return false;
        const collide::Cover<D, Real, Real> cover(world_.colliders, touches_.boxes, to_, filter_of(world_, row));
        const collide::MovingCollider<D, Real> moving(collider, from_, to_, h_, cover);
        bool any = false;
        moving.contacts(begun, ended, kept, [&](const auto& contact) {
            const auto& [point, normal, distance, feature] = contact.surface;
            const auto at = begun + state_.displacement_at(slot);
            const Real lacking = kept - dot(normal, at - point);
            // A surface of several parts: a part behind another one is far beyond the way.
            const Real most = norm(ended - begun - contact.surface_displacement) + kept;
            if (!(lacking > Real(0)) || lacking > most || !is_admitted(row, index, contact)) return;
            state_.set_displacement(slot, state_.displacement_at(slot) + normal * lacking);
            any = true;
        });
        return any;
    }
    bool is_admitted(Row row, std::uint32_t collider, const collide::ColliderContact<D, Real>& contact) const {
        if (!filter_) return true;
        const auto rub = surface_between(world_, row, world_.colliders[collider]);
        const auto& normal = contact.surface.normal;
        const auto slot = state_.slot_of[row];
        const auto moved = state_.displacement_at(slot) - contact.surface_displacement;
        const auto away = state_.position_at(slot) - contact.surface.point + contact.surface_displacement;
        PendingContact pending{.particle = row,
                               .collider = collider,
                               .gap = double(dot(normal, away) - world_.particles.radius[row]),
                               .speed = -double(dot(normal, moved) / h_),
                               .friction = double(rub.friction),
                               .restitution = double(rub.restitution)};
        pending.set_normal(normal);
        return filter_.ask(pending);
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/collide/moving_collider.h"
#include "sinew/solver/contact/collider_sweep.h"

namespace sinew::detail {

/// Last look at the displacements of a substep: no middle of a particle passes the surface of a collider. Rows of
/// contact keep out what was predicted to pass; links that are made exact afterwards may press a limb through a wall
/// thinner than the correction, and a row of the next substep would then keep it behind.
template <int D, class Real> class WallGuard {
  public:
    /// `from`, `to`: shares of the step at the ends of the substep, of length `h`.
    WallGuard(World<D, Real>& world, Solver<D, Real>& solver, Real h, Real from, Real to)
        : world_(world), state_(solver.sweep_state), touches_(solver.touches), contacts_(*solver.contacts),
          filter_(solver.options.contact_filter), h_(h), from_(from), to_(to) {}

    void hold() {
        if (world_.colliders.empty()) return;
        for (const auto& particle : contacts_.particles)
            if (is_fast(particle.row)) hold(particle.row);
    }

  private:
    static constexpr Real share_kept = Real(0.25); ///< of the radius, between middle and surface
    World<D, Real>& world_;
    SweepState<D, Real>& state_;
    const ColliderTouches<D, Real>& touches_;
    const ContactRoom<D, Real>& contacts_;
    const ContactFilter& filter_;
    Real h_, from_, to_;

    /// What moves less is kept out by rows that last from substep to substep.
    bool is_fast(Row row) const {
        const auto moved = state_.displacement_at(state_.slot_of[row]);
        return state_.mobility[state_.slot_of[row]] > Real(0) &&
               dot(moved, moved) > square(share_kept * world_.particles.radius[row]);
    }
    void hold(Row row) {
        const Row slot = state_.slot_of[row];
        const Real radius = share_kept * world_.particles.radius[row];
        const auto filter = filter_of(world_, row);
        const auto begun = state_.position_at(slot);
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            const auto& collider = world_.colliders[i];
            const auto ended = begun + state_.displacement_at(slot);
            collide::BoundingBox<D, Real> way;
            way.include(begun);
            way.include(ended);
            if (collider.is_sensor || !touches_.boxes[i].overlaps(way.grown(radius)) || !touch(collider.filter, filter))
                continue;
            const collide::Cover<D, Real, Real> cover(world_.colliders, touches_.boxes, to_, filter);
            const collide::MovingCollider<D, Real> moving(collider, from_, to_, h_, cover);
            moving.contacts(begun, ended, radius, [&](const auto& contact) {
                const auto& surface = contact.surface;
                const auto at = begun + state_.displacement_at(slot);
                const Real lacking = radius - dot(surface.normal, at - surface.point);
                if (contact.begun_depth > Real(0) || !(lacking > Real(0)) || !is_admitted(row, i, contact)) return;
                state_.set_displacement(slot, state_.displacement_at(slot) + surface.normal * lacking);
            });
        }
    }
    bool is_admitted(Row row, std::uint32_t collider, const collide::ColliderContact<D, Real>& contact) const {
        if (!filter_) return true;
        const auto rub = surface_between(world_, row, world_.colliders[collider]);
        const auto& normal = contact.surface.normal;
        const auto moved = state_.displacement_at(state_.slot_of[row]) - contact.surface_displacement;
        PendingContact pending{.particle = row,
                               .collider = collider,
                               .gap = -double(contact.begun_depth),
                               .speed = -double(dot(normal, moved) / h_),
                               .friction = double(rub.friction),
                               .restitution = double(rub.restitution)};
        pending.set_normal(normal);
        return filter_.ask(pending);
    }
};

} // namespace sinew::detail

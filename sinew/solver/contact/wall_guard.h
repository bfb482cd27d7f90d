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
    /// `from`, `to`: shares of the step at the ends of the substep.
    WallGuard(World<D, Real>& world, Solver<D, Real>& solver, SubstepMover<D, Real>& mover, Real from, Real to)
        : world_(world), state_(solver.sweep_state), touches_(solver.touches), contacts_(*solver.contacts),
          plane_(world, solver, mover), h_(mover.h), from_(from), to_(to) {}

    void hold() {
        constexpr int rounds = 3; // out of a corner
        if (world_.colliders.empty()) return;
        for (const auto& particle : contacts_.particles) {
            const Row slot = state_.slot_of[particle.row];
            int left = state_.mobility[slot] > Real(0) && !contacts_.is_buried_at(slot) ? rounds : 0;
            while (left > 0 && hold(particle.row)) --left;
        }
    }

  private:
    static constexpr Real share_kept = Real(0.25); ///< of the radius, between middle and surface
    World<D, Real>& world_;
    SweepState<D, Real>& state_;
    const ColliderTouches<D, Real>& touches_;
    const ContactRoom<D, Real>& contacts_;
    PlaneContact<D, Real> plane_;
    Real h_, from_, to_;

    /// True if a collider has cut the displacement.
    bool hold(Row row) {
        const auto moved = state_.displacement_at(state_.slot_of[row]);
        const bool is_fast = dot(moved, moved) > square(share_kept * world_.particles.radius[row]);
        bool any = false;
        for (std::uint32_t i = 0; i < world_.colliders.size(); ++i) {
            const auto& collider = world_.colliders[i];
            // Rows, which last from substep to substep, keep out slower motions.
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
            const auto& point = contact.surface.point;
            const auto& normal = contact.surface.normal;
            const Real lacking = kept - dot(normal, begun + state_.displacement_at(slot) - point);
            // A part behind another one, on a surface of several, is far beyond the way.
            const Real most = norm(ended - begun - contact.surface_displacement) + kept;
            auto rub = surface_between(world_, row, collider);
            if (!(lacking > Real(0)) || lacking > most ||
                !plane_.is_admitted({normal, dot(normal, point)}, slot, contact.surface_displacement, index, rub))
                return;
            state_.set_displacement(slot, state_.displacement_at(slot) + normal * lacking);
            any = true;
        });
        return any;
    }
};

} // namespace sinew::detail

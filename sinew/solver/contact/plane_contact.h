#pragma once

#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/substep_mover.h"

#include <optional>

/// Contact of a swept particle with a plane; a collider is a plane at each contact.
namespace sinew::detail {

template <int D, class Real> class PlaneContact {
  public:
    PlaneContact(World<D, Real>& world, Solver<D, Real>& solver, SubstepMover<D, Real>& mover)
        : world_(world), p_(world.particles), swept_(solver.sweep_state), mover_(mover),
          by_rows_(has_figure_contacts(solver) ? solver.contacts->by_rows.data() : nullptr) {}

    /// Non-penetration, and Coulomb friction, which shortens the tangential displacement relative to the surface by
    /// friction times the normal correction. Approaches too fast for resting contact are recorded for rebound(), those
    /// without restitution too: a blow is over at the end of a substep. `collider`: 1 + its index, or 0. Returns the
    /// normal correction.
    Real keep_in(const HalfSpace<D, Real>& plane, Row slot, std::uint32_t collider) const {
        return keep_in(plane, slot, {}, std::nullopt, collider);
    }
    /// Same for a surface that moves; `begun` is the depth at the start of the substep, unless the plane itself tells.
    Real keep_in(const HalfSpace<D, Real>& plane, Row slot, const Vec<D, Real>& surface_displacement,
                 std::optional<Real> begun, std::uint32_t collider) const {
        if (swept_.mobility[slot] == Real(0) || (by_rows_ && by_rows_[slot])) return 0;
        const Row row = swept_.row_of[slot];
        Real depth = plane.depth_of(mover_.point_at(slot), p_.radius[row]);
        if (!(depth > Real(0))) return 0;
        if (!begun) begun = plane.depth_of(swept_.position_at(slot), p_.radius[row]);
        if (*begun > Real(0)) {
            depth -= depth_left(*begun, norm(forcing_on(world_, row, swept_.position_at(slot)).acceleration), mover_.h);
            if (!(depth > Real(0))) return 0;
        }
        if (!swept_.bodies.touched.empty()) swept_.bodies.touched[slot] = 1;
        const RelativeMotion<D, Real> motion(plane.normal, swept_.displacement_at(slot) - surface_displacement);
        const Real stopped = min(depth, mover_.furthest);
        const Real slowed = coulomb_share(plane.friction * stopped, norm(motion.along));
        mover_.displace_at(slot, plane.normal * stopped - motion.along * slowed);
        if (!mover_.first_iteration) return stopped;
        const Real added = mover_.h * norm(forcing_on(world_, row, swept_.position_at(slot)).acceleration);
        const Real carried = dot(plane.normal, surface_displacement) * mover_.per_h;
        const auto away = rebound_after(motion.approach * mover_.per_h, plane.restitution, added);
        if (!away || *away + carried < Real(0)) return stopped;
        auto& blow = swept_.blows[slot];
        blow.away += plane.normal * max(least_speed, *away + carried);
        blow.surface = surface_displacement * mover_.per_h, blow.friction = plane.friction, blow.collider = collider;
        return stopped;
    }

  private:
    static constexpr Real least_speed = Real(1e-9); ///< after a blow: tells the direction of one that leaves none
    World<D, Real>& world_;
    Particles<D, Real>& p_;
    SweepState<D, Real>& swept_;
    SubstepMover<D, Real>& mover_;
    const char* by_rows_; ///< per slot: held by rows of contact instead
};

} // namespace sinew::detail

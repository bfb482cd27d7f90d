#pragma once

#include "sinew/solver/contact/contact_law.h"
#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/contact/wall_surface.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/substep_mover.h"

#include <optional>
#include <span>

/// Contact of a swept particle with a plane; a collider is a plane at each contact.
namespace sinew::detail {

/// Friction of a wall on a particle that moves along it, up to `bound`: returns what takes effect on the particle, and
/// turns one that rolls. `per`: motion for a unit of displacement in the substep.
template <int D, class Real>
Vec<D, Real> rub(SweepState<D, Real>& swept, Row slot, const Vec<D, Real>& normal, const Vec<D, Real>& along,
                 Real bound, Real per = 1) {
    if (!swept.rolls(slot)) return along * coulomb_share(bound, norm(along));
    auto& roller = swept.rollers[slot];
    const auto slip = along + slip_of_rim(roller.rim * per, normal);
    const auto slowed = slip * min(coulomb_share(bound, norm(slip)), Real(1) / (Real(1) + roller.per_inertia));
    roller.rim -= turn_of_rim(normal, slowed) * (roller.per_inertia / per);
    return slowed;
}

template <int D, class Real> class PlaneContact {
  public:
    PlaneContact(World<D, Real>& world, Solver<D, Real>& solver, SubstepMover<D, Real>& mover)
        : world_(world), p_(world.particles), swept_(solver.sweep_state), mover_(mover),
          by_rows_(has_figure_contacts(solver) ? solver.contacts->by_rows.data() : nullptr),
          filter_(solver.options.contact_filter) {}

    /// Non-penetration, and Coulomb friction, which shortens the tangential displacement relative to the surface by
    /// friction times the normal correction. An approach too fast for resting contact is a blow: what is left of the
    /// substep after the impact is the way back. Blows are recorded for rebound(), those without restitution too: a
    /// blow is over at the end of a substep. `collider`: 1 + its index, or 0. Returns the normal correction.
    Real keep_in(const HalfSpace<D, Real>& plane, Row slot, std::uint32_t collider) const {
        if (!is_held(slot)) return 0;
        auto surface = surface_between(world_, swept_.row_of[slot], plane);
        if (filter_ && plane.depth_of(mover_.point_at(slot), p_.radius[swept_.row_of[slot]]) > Real(0) &&
            !is_admitted(plane, slot, {}, PendingContact::none, surface))
            return 0;
        return keep_in(plane, surface, slot, {}, std::nullopt, collider);
    }
    /// True if walls hold the particle here, not rows of contact.
    bool is_held(Row slot) const { return swept_.mobility[slot] != Real(0) && !(by_rows_ && by_rows_[slot]); }
    /// The program's answer about a particle that a surface is about to hold, which may change how both rub and bounce.
    bool is_admitted(const HalfSpace<D, Real>& plane, Row slot, const Vec<D, Real>& surface_displacement, Row collider,
                     WallSurface<Real>& surface) const {
        if (!filter_) return true;
        const auto motion = swept_.displacement_at(slot) - surface_displacement;
        PendingContact contact{.particle = swept_.row_of[slot],
                               .collider = collider,
                               .gap = -double(plane.depth_of(swept_.position_at(slot), p_.radius[swept_.row_of[slot]])),
                               .speed = -double(dot(plane.normal, motion) * mover_.per_h),
                               .friction = double(surface.friction),
                               .restitution = double(surface.restitution)};
        contact.set_normal(plane.normal);
        if (!filter_.ask(contact)) return false;
        surface = {Real(contact.restitution), Real(contact.friction)};
        return true;
    }
    /// Same for a surface that moves; `begun` is the depth at the start of the substep, unless the plane itself tells.
    Real keep_in(const HalfSpace<D, Real>& plane, const WallSurface<Real>& surface, Row slot,
                 const Vec<D, Real>& surface_displacement, std::optional<Real> begun, std::uint32_t collider) const {
        if (!is_held(slot)) return 0;
        const Row row = swept_.row_of[slot];
        const auto [restitution, friction] = surface;
        if (!begun) begun = plane.depth_of(swept_.position_at(slot), p_.radius[row]);
        const auto forced = forcing_on(world_, row, swept_.position_at(slot)).acceleration;
        const Real depth = depth_of(plane, slot, *begun, forced);
        if (!(depth > Real(0))) return 0;
        if (!swept_.bodies.touched.empty()) swept_.bodies.touched[slot] = 1;
        auto& blows = swept_.blows[slot];
        if (blows.count == 0) blows.displacement = swept_.displacement_at(slot);
        const Real approach = dot(plane.normal, surface_displacement - blows.displacement);
        const auto blow =
            mover_.first_iteration ? blow_of(plane.normal, restitution, approach, *begun, forced) : std::nullopt;
        const RelativeMotion<D, Real> motion(plane.normal, swept_.displacement_at(slot) - surface_displacement);
        const Real stopped = min(depth + (blow ? blow->departure : Real(0)), mover_.furthest);
        const auto slowed = rub(swept_, slot, plane.normal, motion.along, friction * stopped);
        mover_.displace_at(slot, plane.normal * stopped - slowed);
        const Real carried = dot(plane.normal, surface_displacement) * mover_.per_h;
        if (blow && blow->away * mover_.per_h + carried >= Real(0))
            blows.add({plane.normal, blow->away * mover_.per_h + carried, stopped * mover_.per_h,
                       surface_displacement * mover_.per_h, friction, collider});
        return stopped;
    }

    /// Moves a particle that several surfaces hold until none lacks anything: each push may end behind another surface.
    /// Calls visit(contact, normal correction). `contacts`: plane and depth at the start of the substep.
    template <class Contact, class Visit>
    void settle(std::span<const Contact> contacts, Row slot, Visit&& visit) const {
        constexpr int enough = 32;         // in a valley of 30 degrees
        constexpr Real exact = Real(1e-3); // of the first correction
        const auto forced = forcing_on(world_, swept_.row_of[slot], swept_.position_at(slot)).acceleration;
        Real first = 0;
        for (int i = 0; i < enough; ++i) {
            Real most = 0;
            for (const auto& contact : contacts) {
                const Real lacking = depth_of(contact.plane, slot, contact.begun, forced);
                if (!(lacking > Real(0))) continue;
                mover_.displace_at(slot, contact.plane.normal * lacking);
                visit(lacking);
                most = max(most, lacking);
            }
            first = max(first, most);
            if (most <= exact * first) return;
        }
    }

  private:
    /// Depth of a particle at the end of the substep, beyond what an old overlap may keep.
    Real depth_of(const HalfSpace<D, Real>& plane, Row slot, Real begun, const Vec<D, Real>& forced) const {
        const Real depth = plane.depth_of(mover_.point_at(slot), p_.radius[swept_.row_of[slot]]);
        return begun > Real(0) && depth > Real(0) ? depth - depth_left(begun, norm(forced), mover_.h) : depth;
    }
    struct Blow {
        Real away = 0;      ///< displacement in a substep after the blow
        Real departure = 0; ///< from the surface at the end of the substep
    };
    /// A particle that begins the substep in front of the surface meets it after the share tau of it. Velocities are
    /// those of the middle of the substep; with the displacement g that the forces add towards the surface
    ///
    ///     away = e approach + (1 + e) g (tau - 1/2),      departure = away (1 - tau) - g tau (1 - tau) / 2
    ///
    /// which keeps the energy for e = 1, whenever the impact comes.
    std::optional<Blow> blow_of(const Vec<D, Real>& normal, Real restitution, Real approach, Real begun,
                                const Vec<D, Real>& forced) const {
        const auto away = rebound_after(approach, restitution, square(mover_.h) * norm(forced));
        if (!away || *away == Real(0)) return away ? std::optional(Blow{}) : std::nullopt;
        constexpr Real half = Real(0.5);
        const Real tau = clamp(-begun / approach, Real(0), Real(1));
        const Real added = -dot(normal, forced) * square(mover_.h);
        const Real departing = max(Real(0), *away + (Real(1) + restitution) * added * (tau - half));
        return Blow{departing, max(Real(0), (departing - half * added * tau) * (Real(1) - tau))};
    }

    World<D, Real>& world_;
    Particles<D, Real>& p_;
    SweepState<D, Real>& swept_;
    SubstepMover<D, Real>& mover_;
    const char* by_rows_; ///< per slot: held by rows of contact instead
    const ContactFilter& filter_;
};

} // namespace sinew::detail

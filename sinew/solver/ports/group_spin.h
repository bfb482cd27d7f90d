#pragma once

#include "sinew/solver/ports/group_motion.h"

/// Angular momentum of a free group: constraints act within, and must not change this.
namespace sinew::detail {

/// Angular momentum about its centre that a free group has after the substep: the initial one and the moment of the
/// external impulses, about the mean of the centres at both ends.
template <int D, class Real> typename RigidMotion<D>::Spin due_spin(const GroupMotion<D, Real>& group) {
    const auto after = group.rigid();
    const auto drift = after.momentum * inverse_or_zero(after.mass);
    typename RigidMotion<D>::Spin spin{};
    for (const auto s : group.members()) {
        const auto arm = group.position(s) - after.center;
        spin += moment(arm, group.last_displacement(s) * group.mass(s));
        spin += moment(arm + (group.displacement(s) - drift) * 0.5,
                       (group.free_move(s) - group.last_displacement(s)) * group.mass(s));
    }
    return spin;
}

/// Rate of a rotation, with as much of the added one as raises the energy by `max_rise` or less: the fraction f of
///
///     q f^2 + a f = max_rise,        0 <= f <= 1
template <int D, class Real>
typename RigidMotion<D>::Spin affordable_rate(const GroupMotion<D, Real>& group, const GroupFrame<D, Real>& present,
                                              const GroupFrame<D, Real>& added, double max_rise) {
    const GroupFrame<D, Real> still{present.center, present.velocity, {}};
    auto whole = present;
    whole.rate = present.rate + added.rate;
    const double rise = group.energy_between(present, whole);
    if (rise <= max_rise) return whole.rate;
    const double q = group.energy_between(still, added), a = rise - q;
    const double root = square_root(max(a * a + 4 * q * max_rise, 0.0));
    const double f = a >= 0 ? 2 * max_rise * inverse_or_zero(a + root) : (root - a) * inverse_or_zero(2 * q);
    return present.rate + added.rate * clamp(f, 0.0, 1.0);
}

/// Rate of a rotation that has `owed` less energy, or none.
template <int D, class Real>
typename RigidMotion<D>::Spin slower_rate(const GroupMotion<D, Real>& group, const GroupFrame<D, Real>& present,
                                          double owed) {
    const GroupFrame<D, Real> still{present.center, present.velocity, {}};
    const double share = 1 - owed * inverse_or_zero(group.energy_between(still, present));
    return present.rate * square_root(max(share, 0.0));
}

/// Turns the velocities of a free group until its angular momentum is `spin`. The energy of the rotation is `lost`,
/// what constraints have taken in the substep, and then a part of the rest of the motion: a lost spin gained back must
/// not be gained twice. Energy that they have added, `lost` < 0, is taken from the rest of the motion, and then from
/// the rotation. Without as much energy some of the spin stays lost, as where a mesh drawn out by a load contracts: the
/// same spin would turn it faster. A motorized group is given any energy.
template <int D, class Real>
void restore_spin(const GroupMotion<D, Real>& group, const typename RigidMotion<D>::Spin& spin, double lost,
                  bool motorized) {
    const auto now = group.rigid();
    auto missing = now;
    missing.spin = spin - now.spin;
    const auto present = group.frame_of(now), added = group.frame_of(missing);
    const double inner = group.energy_beside(present);
    auto due = present;
    const double left = inner + lost;
    due.rate = motorized  ? present.rate + added.rate
               : left < 0 ? slower_rate(group, present, -left)
                          : affordable_rate(group, present, added, left);
    const double rise = group.energy_between(present, due) - lost;
    const double share = rise > 0 ? square_root(max(0.0, 1 - rise * inverse_or_zero(inner))) : 1;
    group.replace(present, due, share);
}

/// Moves a free group as one rigid body with a given spin: of all motions with this spin the one of least energy, for a
/// substep in which constraints add more than all of the inner motion.
template <int D, class Real>
void stiffen(const GroupMotion<D, Real>& group, const typename RigidMotion<D>::Spin& spin) {
    auto due = group.rigid();
    due.spin = spin;
    group.stiffen(group.frame_of(due));
}

} // namespace sinew::detail

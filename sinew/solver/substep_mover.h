#pragma once

#include "sinew/solver/sweep_state.h"
#include "sinew/world/world.h"

#include <span>

/// Access to the particles of the sweep for constraints and contacts.
namespace sinew::detail {

/// Constraints act on the predicted position place + move, and correct the displacement move = h v. Differences of
/// large coordinates are never taken, so float loses least. Displacements are bounded by the width of the world:
/// positions stay finite.
template <int D, class RealT> struct SubstepMover {
    using Real = RealT;
    static constexpr int dimension = D;
    SweepState<D, Real>& sweep_state;
    Real h;
    Real per_h = Real(1) / h;
    Real furthest = max_displacement(h);
    bool first_iteration = true;

    Vec<D, Real> point(Row row) const { return point_at(sweep_state.slot_of[row]); }
    Vec<D, Real> point_at(Row slot) const { return sweep_state.position_at(slot) + sweep_state.displacement_at(slot); }
    /// Lengths below which a bend fades with its legs.
    std::array<Real, 2> bend_legs(Row bend) const {
        return sweep_state.bend_legs.empty() ? std::array<Real, 2>{} : sweep_state.bend_legs[bend];
    }
    Real weight(Row row) const { return sweep_state.mobility[sweep_state.slot_of[row]]; }
    Real alpha(Real compliance) const { return min(compliance * per_h * per_h, limit::measure<Real>); }
    Real max_multiplier(Real max_force) const { return min(max_force * h * h, limit::multiplier<Real>); }
    Real share(Real damping_time) const { return min(damping_time * per_h, limit::coordinate<Real>); }
    /// damping_time (dC/dt - motor_speed), at the present velocities; `rate` is the rate of the limits.
    template <class Stencil>
    Real ahead(const Stencil& stencil, std::span<const Row> members, Real damping_time, Real rate) const {
        Real own = -rate;
        stencil.each([&](std::size_t i) {
            own += dot(stencil.gradient[i], sweep_state.velocity_at(sweep_state.slot_of[members[i]]));
        });
        return own * damping_time;
    }
    void displace(Row row, const Vec<D, Real>& displacement) { displace_at(sweep_state.slot_of[row], displacement); }
    void displace_at(Row slot, const Vec<D, Real>& displacement) {
        sweep_state.set_displacement(slot,
                                     clamp_components(sweep_state.displacement_at(slot) + displacement, furthest));
    }

    /// Corrections along the gradient at the start of the substep (SHAKE: Ryckaert, Ciccotti and Berendsen 1977)
    /// conserve the energy of a swing; along the gradient at the end they dissipate it. If the two directions disagree,
    /// only the latter still corrects.
    template <class Stencil> void choose_direction(Stencil& stencil, std::span<const Row> members) const {
        stencil.each(
            [&](std::size_t i) { stencil.points[i] = sweep_state.position_at(sweep_state.slot_of[members[i]]); });
        stencil.evaluate(stencil.points, stencil.direction);
        Real along = 0, now = 0, then = 0;
        stencil.each([&](std::size_t i) {
            along += dot(stencil.gradient[i], stencil.direction[i]);
            now += dot(stencil.gradient[i], stencil.gradient[i]);
            then += dot(stencil.direction[i], stencil.direction[i]);
        });
        if (along < Real(min_agreement) * max(now, then)) stencil.direction = stencil.gradient;
    }
};

} // namespace sinew::detail

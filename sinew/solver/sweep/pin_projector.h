#pragma once

#include "sinew/solver/contact/contact_room.h"
#include "sinew/solver/pin_spring.h"
#include "sinew/solver/substep_mover.h"

#include <algorithm>

namespace sinew::detail {

/// Pins of the sweep in one substep: a hard pin carries the particle, a compliant one pulls.
template <int D, class Real> class PinProjector {
  public:
    /// `from`, `share`: shares of the step at the ends of the substep; `is_later`: after the first substep.
    PinProjector(World<D, Real>& world, Solver<D, Real>& solver, SubstepMover<D, Real>& mover, Real from, Real share,
                 bool is_later)
        : world_(world), solver_(solver), swept_(solver.sweep_state), mover_(mover), from_(from), share_(share),
          is_later_(is_later) {}

    bool any_soft(const Tile& tile) const {
        if (!swept_.any_pin_soft) return false;
        for (auto i = tile.first_pin; i < tile.last_pin; ++i)
            if (!world_.pins[swept_.plan.pins[i].pin].hard()) return true;
        return false;
    }

    /// Moves particles to their hard pins' targets; the displacement is their velocity. From the second substep on
    /// pins at rest are skipped.
    void move(const Tile& tile) {
        if (is_later_ && !swept_.any_pin_moves) return;
        for (auto i = tile.first_pin; i < tile.last_pin; ++i) {
            const auto& pin = world_.pins[swept_.plan.pins[i].pin];
            const Row slot = swept_.plan.pins[i].slot;
            const bool rests = is_later_ && pin.from == pin.target;
            if (rests || !pin.hard() || world_.particles.quarantined[swept_.row_of[slot]]) continue;
            const auto goal = pin.target_at(share_);
            swept_.set_displacement(slot, clamp_components(goal - swept_.position_at(slot), mover_.furthest));
        }
    }

    /// Compliant pins are damped springs to their target: dlambda = -(e + alpha lambda + gamma u) / (w (1 + gamma)
    /// + alpha), e the offset from the target and u the change of e in the substep; the force never exceeds
    /// max_force.
    void pull(const Tile& tile) {
        for (auto i = tile.first_pin; i < tile.last_pin; ++i) {
            auto& pin = world_.pins[swept_.plan.pins[i].pin];
            const Row slot = swept_.plan.pins[i].slot;
            const Real w = swept_.mobility[slot];
            if (pin.hard() || w == Real(0) || is_held_exactly(solver_, slot)) continue;
            const Real alpha = mover_.alpha(pin.compliance);
            const Real gamma = pin_gamma(pin, w, mover_.per_h);
            const auto goal = pin.target_at(share_);
            const auto error = mover_.point_at(slot) - goal;
            const auto last_goal = pin.target_at(from_);
            const auto drift = error - (swept_.position_at(slot) - last_goal);
            const auto lambda = mover_.first_iteration ? Vector{} : pin.multiplier;
            const Real per_resistance = inverse_or_zero(w * (Real(1) + gamma) + alpha);
            auto next = clamp_components(lambda - (error + lambda * alpha + drift * gamma) * per_resistance,
                                         limit::multiplier<Real>);
            if (pin.max_force > Real(0)) {
                const Real max = pin.max_force * mover_.h * mover_.h;
                next *= min(Real(1), max * inverse_or_zero(norm(next)));
            }
            mover_.displace_at(slot, (next - lambda) * w);
            pin.multiplier = next;
        }
    }

  private:
    using Vector = Vec<D, Real>;

    World<D, Real>& world_;
    Solver<D, Real>& solver_;
    SweepState<D, Real>& swept_;
    SubstepMover<D, Real>& mover_;
    Real from_, share_;
    bool is_later_;
};

} // namespace sinew::detail

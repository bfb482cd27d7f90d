#pragma once

#include "sinew/math/decay.h"
#include "sinew/solver/phases.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/substep_mover.h"

#include <limits>

namespace sinew::detail {

/// Free motion in one substep: x* = x + h v + h^2 a, time-corrected when h changes: the kick spans from the middle of
/// the last substep to the middle of this one. Drag scales mobilities by the same factor as the forcing, so a weight at
/// rest pulls with its full weight at any damping.
template <int D, class Real> class Predictor {
  public:
    /// `number`: of the substep, from 1.
    Predictor(World<D, Real>& world, SweepState<D, Real>& swept, const SubstepMover<D, Real>& mover, int number)
        : world_(world), swept_(swept), h_(mover.h), furthest_(mover.furthest), number_(number),
          kick_(number == 1 ? Real(0.5) * (world.last_substep + mover.h) : mover.h) {
        if (swept_.everyone_alike)
            decay_ = Decay<Real>::of(clamp(world.settings.damping, Real(0), limit::measure<Real>), kick_);
    }

    /// Factor of velocities by the common damping.
    Real keep() const { return decay_.keep; }

    /// Sets the motion under gravity and the common damping, for kernels.
    void fall(Motion<D, Real>& motion) const {
        motion.keep = decay_.keep;
        const auto add = clamp_components(swept_.gravity * (kick_ * decay_.yield) * h_, furthest_);
        for (int i = 0; i < D; ++i) motion.add[i] = add[i];
    }

    /// Predicts a particle under forces of its own.
    void predict(Row slot) {
        if (swept_.mobility[slot] == Real(0)) {
            swept_.set_displacement(slot, {}); // immovable, unless carried by a pin
            return;
        }
        const auto forcing = forcing_on(world_, swept_.row_of[slot], swept_.position_at(slot));
        const Real rate = clamp(world_.settings.damping + forcing.drag_rate, Real(0), limit::measure<Real>);
        if (rate != decay_.rate) decay_ = Decay<Real>::of(rate, kick_);
        const auto pushed =
            swept_.displacement_at(slot) * decay_.keep + forcing.acceleration * (kick_ * decay_.yield) * h_;
        swept_.set_displacement(slot, clamp_components(pushed, furthest_));
        if (!swept_.rollers.empty()) swept_.rollers[slot].rim *= decay_.keep;
        weigh(slot);
    }
    /// Slows the turns down by the common damping.
    void slow_turns(const Tile& tile) {
        if (swept_.rollers.empty()) return;
        for (Row slot = tile.first; slot < tile.last; ++slot) swept_.rollers[slot].rim *= decay_.keep;
    }

    /// Scales mobilities by the common drag. Kicks are equally long from the second substep on: later substeps change
    /// nothing.
    void weigh(const Tile& tile) {
        if (decay_.yield == Real(1) || number_ > 2) return;
        for (Row slot = tile.first; slot < tile.last; ++slot) weigh(slot);
    }

  private:
    World<D, Real>& world_;
    SweepState<D, Real>& swept_;
    Real h_, furthest_;
    int number_;
    Real kick_;         ///< duration of the forcing
    Decay<Real> decay_; ///< cached: most particles share a rate

    void weigh(Row slot) {
        if (swept_.mobility[slot] > Real(0))
            swept_.mobility[slot] = max(world_.particles.inverse_mass[swept_.row_of[slot]] * decay_.yield,
                                        std::numeric_limits<Real>::min());
    }
};

} // namespace sinew::detail

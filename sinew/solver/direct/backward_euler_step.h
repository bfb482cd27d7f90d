#pragma once

#include "sinew/solver/direct/substep.h"

namespace sinew::detail {

/// A substep by backward Euler, after a blow or where the midpoint rule found no solution.
template <int D, class Real> class BackwardEulerStep {
  public:
    explicit BackwardEulerStep(BlockSubstep<D, Real>& substep)
        : substep_(substep), state_(substep.state()), solve_(substep.solve()), energy_(substep.energy()) {}

    /// False without a solution, unless `forced`: then springs are disabled, and `creep` is the last resort.
    bool run(bool forced) {
        substep_.project_positions();
        kinetic_ = solve_.kinetic();
        bool found = substep_.run(Rule::backward_euler, substep_.many);
        if (!found && !forced) return false;
        if (!found && state_.block.springy) {
            state_.start_tensions();
            solve_.bends().disable_springs(true);
            found = substep_.run(Rule::backward_euler, substep_.many) && due() >= 0;
        }
        if (!found) creep();
        // A cable with an end at a wheel has no solution: its leg has no direction there. Velocities other than those
        // of the way made would stay as they were on arrival.
        const bool is_at_wheel = !found && state_.block.ways > 0;
        if (is_at_wheel || substep_.contact().near() || !state_.works_alone() || state_.block.springy)
            substep_.take_mean_velocities();
        else
            keep_flying();
        substep_.report_pressures();
        substep_.project_velocities();
        substep_.report_rebounds();
        energy_.keep_momentum();
        if (!is_at_wheel) give_back();
        substep_.note_lost(due() - solve_.kinetic());
        return true;
    }

  private:
    BlockSubstep<D, Real>& substep_;
    BlockState<D, Real>& state_;
    BlockSolve<D>& solve_;
    const BlockEnergy<D>& energy_;
    double kinetic_ = 0; ///< kinetic energy at the start, J

    /// Kinetic energy due at the end, J.
    double due() const { return kinetic_ + energy_.work(); }
    /// False for a motion that takes more energy than there is; walls lift figures that begin behind them.
    bool is_possible() const { return substep_.contact().near() || !state_.works_alone() || due() >= 0; }

    /// Fallback: a linear step towards the solution, halved until lengths and energy are tolerable. Some of the way is
    /// always made, which leaves a state without a solution behind.
    void creep() {
        constexpr double bearable = 1e-5;
        state_.forget_tensions();
        solve_.bends().disable_springs(false);
        solve_.use_penalty();
        substep_.run(Rule::backward_euler, 1);
        const double max_strain = max(bearable, solve_.worst_start_strain());
        substep_.retreat([&] { return solve_.worst_position_strain() <= max_strain && is_possible(); });
        energy_.keep_flight();
        state_.start_tensions();
    }

    /// Velocities as without links, for the projection. A position not found to the last digit, over a short substep,
    /// would give wrong velocities to everything heavy.
    void keep_flying() {
        for (auto& node : state_.unknowns()) node.velocity += node.acceleration * state_.substep();
    }

    /// Backward Euler takes energy, most of it from a light part that whips; an undamped block gets it back, but for a
    /// thousandth, which is more than the rounding of all energies: none is gained.
    void give_back() {
        constexpr double share = 0.999;
        const double left = solve_.kinetic(), due_now = due();
        if (substep_.loses_nothing() && !state_.block.springy)
            energy_.bring_to(max(min(due_now, left + share * (due_now - left)), 0.0));
        else if (state_.works_alone())
            energy_.slow_down(due_now);
    }
};

} // namespace sinew::detail

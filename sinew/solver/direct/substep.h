#pragma once

#include "sinew/solver/direct/contact_rows.h"
#include "sinew/solver/direct/energy.h"
#include "sinew/solver/direct/project_velocities.h"
#include "sinew/solver/direct/relax_links.h"

namespace sinew::detail {

/// A substep of a block: the loaded state with the equations to solve, and the energy accounts.
template <int D, class Real> class BlockSubstep {
  public:
    using Solve = BlockSolve<D>;
    using Energy = BlockEnergy<D>;

    static constexpr int many = 40; ///< iterations of a solve that must not fail

    /// `lost` adds up the energy lost, J.
    BlockSubstep(BlockState<D, Real>& state, BlockContact<D, Real>& contact, double& lost)
        : state_(state), contact_(contact), lost_(lost), solve_(state.blocks, state.block, state.substep()),
          energy_(solve_, is_free()) {}

    BlockState<D, Real>& state() { return state_; }
    BlockContact<D, Real>& contact() { return contact_; }
    Solve& solve() { return solve_; }
    Energy& energy() { return energy_; }

    /// Fits tolerances to light parts; and to free flight, which must not depend on how fast the whole flies.
    void fit() {
        if (moves_alone()) solve_.find_light_trees();
        if (is_free()) solve_.be_precise();
    }

    bool run(Rule rule, int iterations) {
        return solve_.run(rule, iterations,
                          [&] { return contact_.add_external_terms(solve_.links().stiffness(), solve_.progress()); });
    }
    bool refine() {
        return solve_.refine(Rule::midpoint,
                             [&] { contact_.add_external_terms(solve_.links().stiffness(), solve_.progress()); });
    }

    /// True if only force fields and immovable nodes act from outside.
    bool moves_alone() const { return state_.works_alone() && !contact_.near(); }
    /// True if only force fields act from outside.
    bool is_free() const { return state_.fixed().empty() && !state_.motorized() && !contact_.near(); }
    /// True if energy has to be conserved: no damping, no work from outside. A joint then bounces from its limit.
    bool loses_nothing() const {
        constexpr double far_outside = 2e-2; // radians; a joint placed further out is brought back
        return state_.world.settings.damping == Real(0) && state_.works_alone() && !contact_.near() &&
               solve_.bends().worst_outside() < far_outside;
    }

    /// Energy is accounted only while nothing from outside does work.
    void note_lost(double energy) {
        if (state_.works_alone()) lost_ += energy;
    }

    /// Brings a figure that was placed stretched, or torn from its pins, to its lengths without a velocity. False if
    /// the pins are too far apart.
    bool project_positions() {
        constexpr double crude = 1e-3;
        const double before = solve_.worst_start_strain();
        if (before <= crude) return true;
        for (auto& node : state_.fixed()) std::swap(node.start, node.position);
        state_.forget_tensions();
        const bool met = solve_.run(Rule::static_projection, many, [] {});
        if (!met) relax_links(state_.blocks, state_.block);
        const double after = solve_.worst_position_strain();
        if (after < before)
            for (auto& node : state_.unknowns()) node.start = node.position;
        for (auto& node : state_.fixed()) std::swap(node.start, node.position);
        state_.start_tensions();
        return met || after <= crude;
    }

    /// Projects the velocities. Returns the energy lost, J.
    double project_velocities() {
        constexpr int few = 3, enough = 30;
        constexpr double rounding = 1e-6;
        const double kinetic = solve_.kinetic();
        const auto gains = [&] { return moves_alone() && !(solve_.kinetic() <= (1 + rounding) * kinetic); };
        for (const int rounds : {few, enough}) {
            project_block_velocities(
                solve_, [&](double k) { contact_.rebound(k); }, rounds);
            if (!gains()) break;
            for (auto& node : state_.unknowns())
                node.velocity = node.predicted; // a projection gains nothing: not converged
        }
        if (moves_alone()) energy_.slow_down(kinetic);
        return kinetic - solve_.kinetic();
    }

    /// Reports the pushes of colliders, after the solve of the positions; and of the velocities.
    void report_pressures() { contact_.report_pressures(solve_.links().stiffness()); }
    void report_rebounds() { contact_.report_rebounds(velocity_stiffness(solve_)); }

    void take_mean_velocities() {
        const double per_h = 1 / state_.substep();
        for (auto& node : state_.unknowns()) node.velocity = (node.position - node.start) * per_h;
    }

    /// Halves the displacement until `bearable()`, at most 20 times.
    template <class Bearable> void retreat(Bearable&& bearable) {
        constexpr int halvings = 20;
        for (int i = 0; i < halvings && !bearable(); ++i)
            for (auto& node : state_.unknowns()) node.position = (node.position + node.start) * 0.5;
    }

  private:
    BlockState<D, Real>& state_;
    BlockContact<D, Real>& contact_;
    double& lost_;
    Solve solve_;
    Energy energy_;
};

} // namespace sinew::detail

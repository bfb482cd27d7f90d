#pragma once

#include "sinew/solver/direct/joint_stops.h"
#include "sinew/solver/direct/substep.h"

namespace sinew::detail {

/// Outcome of a midpoint step.
enum class Went { well, against_something, past_an_end, too_far };

/// A substep by the midpoint rule, with the energy of the block conserved. A motion too large for one substep is left
/// to shorter ones, as long as there are any.
template <int D, class Real> class MidpointStep {
  public:
    static constexpr int deepest = 3;         ///< maximum depth of division of a substep
    static constexpr int deepest_at_ends = 5; ///< same where joints reach their limits

    /// `longest`: duration of an undivided substep, s.
    MidpointStep(BlockSubstep<D, Real>& substep, double longest, int depth)
        : substep_(substep), state_(substep.state()), solve_(substep.solve()), energy_(substep.energy()),
          longest_(longest), depth_(depth), lossless_(substep.loses_nothing()) {}

    Went run() {
        if (lossless_) solve_.allow_overshoot();
        double gain = 0;
        if (const auto went = find_positions(gain); went != Went::well) return went;
        const double per_h = 1 / state_.substep();
        for (auto& node : state_.unknowns()) node.velocity = (node.position - node.start) * (2 * per_h) - node.velocity;
        if (gain > 1) energy_.slow_down(energy_.due());
        bounce();
        if (!allow_velocities()) return Went::too_far;
        substep_.note_lost(energy_.missing());
        energy_.keep_momentum();
        // The mean gradient of a fold adds a little rotation, and so does momentum that was lost to rounding.
        if (lossless_ && substep_.is_free() && (state_.block.ranges > 0 || energy_.exceeds_due()))
            energy_.slow_down(energy_.due());
        return Went::well;
    }

  private:
    BlockSubstep<D, Real>& substep_;
    BlockState<D, Real>& state_;
    BlockSolve<D>& solve_;
    BlockEnergy<D>& energy_;
    double longest_;
    int depth_;
    bool lossless_;

    bool is_shortest() const { return depth_ >= deepest; }

    /// Positions at the end, and the excess of energy in units of the rounding tolerance.
    Went find_positions(double& gain) {
        constexpr int few = 8;             // iterations: where more are needed, shorter substeps are cheaper
        constexpr double overshoot = 2e-3; // radians beyond a joint's limit, or a fraction of half a range's length
        const bool found = substep_.run(Rule::midpoint, few);
        if (has_struck()) return Went::against_something;
        if (!found) return Went::too_far;
        constexpr double exact = 0.02, slight = 1e3; // in units of the rounding tolerance
        gain = state_.works_alone() ? energy_.gain() : 0;
        if (absolute(gain) > exact) {
            if (!substep_.refine()) return Went::too_far;
            gain = energy_.gain();
        }
        // Redundant links in a plane, exact to a millionth, press each other out of it: the harder, the shorter the
        // substep.
        const bool no_cut_helps = D == 3 && state_.block.braced();
        if (gain > (is_shortest() || no_cut_helps ? slight : 1)) return Went::too_far;
        if (depth_ < deepest_at_ends && solve_.worst_overshoot() > overshoot) return Went::past_an_end;
        return Went::well;
    }

    /// True if a node has reached a plane, or a joint a limit: a blow follows, not a swing.
    bool has_struck() { return substep_.contact().struck() || solve_.bends().any_struck(); }

    /// Bounces joints from their limits. A joint that comes to rest on a limit has little energy, which goes back into
    /// the rest of the motion.
    void bounce() {
        constexpr double part = 1e-5, tiny = 1e-7; // fractions of the energy, and of weight times length
        const double kinetic = solve_.kinetic();
        const double little = part * energy_.inner() + tiny * solve_.weight() * solve_.total_length();
        if (BlockBounce<D>(solve_, little).run()) energy_.bring_to(min(kinetic, energy_.due()));
    }

    /// Projects the velocities where links have tightened, or the integrator was in error. False if a shorter substep
    /// is better.
    bool allow_velocities() {
        if (any_tightened()) {
            substep_.note_lost(substep_.project_velocities());
        } else if (solve_.has_velocity_error(longest_)) {
            const double kinetic = solve_.kinetic();
            if (!remove_velocity_drift() && !is_shortest()) return false;
            substep_.note_lost(kinetic - solve_.kinetic());
        }
        return true;
    }

    bool any_tightened() const {
        for (const auto& link : state_.links())
            if (link.low < link.high && link.before == 0 && link.tension != 0 && !(lossless_ && link.is_range()))
                return true;
        for (const auto& way : state_.ways())
            if (way.one_sided() && way.before == 0 && way.tension != 0) return true;
        return false;
    }

    /// Removes velocities along the links, an error of the integrator after the crack of a whip, and gives their energy
    /// back to the allowed motion. False if the error is large.
    bool remove_velocity_drift() {
        constexpr double much = 1.02;
        const double kinetic = solve_.kinetic(), inner = energy_.inner();
        substep_.project_velocities();
        const bool little = inner <= much * energy_.inner();
        if (!state_.motorized()) energy_.bring_to(kinetic);
        return little;
    }
};

} // namespace sinew::detail

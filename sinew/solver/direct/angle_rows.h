#pragma once

#include "sinew/solver/direct/angle_geometry.h"
#include "sinew/solver/direct/matrices.h"

/// Angles of a block: rigid between their limits, springs and motors; the folds of 3D joints alike.
namespace sinew::detail {

template <int D> class AngleRows {
  public:
    AngleRows(Blocks<D>& blocks, const Block& block, double substep)
        : blocks_(blocks), block_(block), geometry_(blocks), h_(substep) {}

    std::span<AngleRow<D>> all() const { return std::span(blocks_.bends).subspan(block_.first_bend, block_.bends); }
    const AngleGeometry<D>& geometry() const { return geometry_; }

    /// Chooses the active limits at the start of the substep. If limits `bounce` (direct/joint_stops.h), only limits on
    /// which a joint rests are active.
    void set_out(bool bounce) {
        bounce_ = bounce;
        for (auto& bend : all()) {
            bend.flips = bend.doubts = 0;
            bend.slips = false;
            bend.give = 0;
            const double angle = bend.begun = geometry_.angle_of(bend, true);
            bend.taut = geometry_.tautness(bend, true);
            if (bounces(bend)) {
                constexpr double hardly = 1e-6;
                bend.side = bend.tension > 0 && angle > bend.high - hardly  ? 1
                            : bend.tension < 0 && angle < bend.low + hardly ? -1
                                                                            : 0;
                if (bend.side != 0) bend.give = max(beyond(bend, angle), 0.0);
            } else {
                bend.side = !bend.one_sided() || bend.tension > 0 || angle > bend.high ? 1
                            : bend.tension < 0 || angle < bend.low                     ? -1
                                                                                       : 0;
            }
        }
    }

    /// Adds all angles to the equations; returns the largest violation of a limit.
    double assemble(Rule rule, double hardest, double margin) {
        double worst = 0;
        for (auto& bend : all()) worst = max(worst, assemble(bend, rule, hardest, margin));
        return worst;
    }

    /// Adds held angles to equations of the response to impulses: equalities and, if `limits`, loaded limits.
    void stiffen(bool limits, double hardest) {
        for (auto& bend : all()) {
            if (bend.is_compliant() || bend.slips || (bend.one_sided() && !(limits && bend.tension * bend.side > 0)))
                continue;
            geometry_.measure(bend);
            bend.along = bend.gradient;
            bend.stiffness = hardest * geometry_.arm2(bend);
            add(bend, 0);
        }
    }

    double worst_error() const {
        double worst = 0;
        for (const auto& bend : all()) {
            if (bend.is_compliant()) continue;
            const double angle = geometry_.angle_of(bend, false);
            if (bend.side != 0)
                worst = max(worst, absolute(beyond(bend, angle) - bend.give));
            else if (!bounces(bend))
                worst = max(worst, max(angle - bend.high, bend.low - angle));
        }
        return worst;
    }

    /// Excess over the active limit, positive outside.
    static double beyond(const AngleRow<D>& bend, double angle) {
        return bend.side > 0 ? angle - bend.high : bend.low - angle;
    }

    /// True for a limit that a joint can reach, and leaves at the speed of arrival.
    bool bounces(const AngleRow<D>& bend) const {
        return bounce_ && bend.one_sided() && !bend.is_compliant() && !bend.motorized;
    }

    double stored(const AngleRow<D>& bend, bool at_start) const {
        if (!bend.is_compliant()) return 0;
        return bend.spring_energy(geometry_.angle_of(bend, at_start), geometry_.tautness(bend, at_start));
    }

    /// Disables springs from now on, or enables them.
    void disable_springs(bool limp) { limp_ = limp; }

    /// Largest violation of a rigid limit at the start of the substep.
    double worst_outside() const {
        double worst = 0;
        for (const auto& bend : all()) {
            if (bend.is_compliant() || !bend.one_sided()) continue;
            const double angle = geometry_.angle_of(bend, true);
            worst = max(worst, max(angle - bend.high, bend.low - angle));
        }
        return worst;
    }

    /// Largest volume of a flat square, as a fraction of `unit`.
    double worst_warp(bool at_start) const {
        double worst = 0;
        for (const auto& bend : all())
            if (bend.replaces_link) worst = max(worst, absolute(geometry_.angle_of(bend, at_start)));
        return worst;
    }

    bool any_struck() const {
        for (const auto& bend : all())
            if (bend.side != 0 && bend.one_sided() && !bend.is_compliant() && !bounces(bend)) return true;
        return false;
    }

    /// Largest overshoot of a bouncing angle past the limit, and past the angle at the start of the substep.
    double worst_overshoot() const {
        double worst = 0;
        for (const auto& bend : all()) {
            if (bend.side != 0 || !bounces(bend)) continue;
            const double angle = geometry_.angle_of(bend, false);
            worst = max(worst, max(angle - max(bend.high, bend.begun), min(bend.low, bend.begun) - angle));
        }
        return worst;
    }

    // --- velocities

    void begin_settling() {
        for (auto& bend : all()) bend.pull = 0, geometry_.measure(bend), bend.along = bend.gradient;
    }
    void project_velocities(double stiffness) {
        for (auto& bend : all()) {
            const double rate = geometry_.rate_of(bend);
            const double k = stiffness * geometry_.arm2(bend);
            const double pull = bend.pull + k * rate;
            const bool resists =
                bend.side != 0 && !bend.is_compliant() && !bend.slips && (!bend.one_sided() || pull * bend.side > 0);
            bend.stiffness = resists ? k : 0;
            if (resists) add(bend, bend.pull = pull);
        }
    }
    void end_round() {
        for (auto& bend : all())
            if (bend.stiffness > 0) bend.pull += bend.stiffness * geometry_.change(bend);
    }

  private:
    Blocks<D>& blocks_;
    const Block& block_;
    AngleGeometry<D> geometry_;
    double h_;
    bool bounce_ = false, limp_ = false;

    BlockNode<D>& node(std::uint32_t i) const { return blocks_.nodes[i]; }

    /// Adds one angle to the equations; returns the violation of a limit.
    double assemble(AngleRow<D>& bend, Rule rule, double hardest, double margin) {
        double angle = geometry_.measure(bend);
        if (bend.is_compliant()) angle = geometry_.turned_on(bend, angle);
        geometry_.point(bend, rule, angle);
        bend.stiffness = 0;
        if (rule == Rule::static_projection && bend.motorized) return 0; // no time passes: a motor yields
        if (bend.is_compliant()) {
            const double error = bend.error_of(angle);
            if (limp_) bend.tension = 0;
            if (error == 0 || rule == Rule::static_projection || limp_) return 0;
            const double k = bend.spring_stiffness(hardest * geometry_.arm2(bend), bend.taut);
            bend.tension = bend.held(k * (error + bend.damping_time * ((angle - bend.begun) / h_ - bend.motor_speed)),
                                     bend.tension, false);
            bend.stiffness = bend.slips ? 0 : k * (1 + bend.damping_time / h_);
            add(bend, bend.tension);
            if (!bend.slips && !bend.is_fold()) add_curvature(bend, bend.tension, k);
            return 0;
        }
        if (bend.side == 0 && !bounces(bend)) bend.activate(angle - bend.high, angle - bend.low, margin);
        if (bend.side == 0) return 0;
        const double error = bend.side * (beyond(bend, angle) - bend.give);
        bend.stiffness = hardest * geometry_.arm2(bend);
        bend.pull = bend.held(bend.tension + bend.stiffness * error, bend.tension, false);
        if (bend.slips) bend.stiffness = 0;
        add(bend, bend.pull);
        return bend.slips ? 0 : absolute(error);
    }

    /// Adds torque times the second derivative of a spring's angle, without which a stiff bend that is far from its
    /// rest makes Newton's method turn about the solution; and a straight one in space knows no stiffness out of its
    /// plane.
    void add_curvature(const AngleRow<D>& bend, double torque, double k) {
        const auto [uu, vv, uv] = geometry_.curvature(bend, torque, k);
        Matrix<D, double> first{}, outermost{}, second{}, middle = uu;
        first -= uu, first += uv;
        outermost -= uv;
        second -= vv, second += uv;
        middle += vv, middle -= uv, middle -= uv;
        const std::array own = {uu, middle, vv}, pairs = {first, outermost, second};
        for (std::size_t i = 0, pair = 0; i < 3; ++i) {
            node(bend.nodes[i]).diagonal += own[i];
            for (std::size_t j = i + 1; j < 3; ++j, ++pair) {
                if (bend.entries[pair] == Blocks<D>::none) continue;
                auto& entry = blocks_.entries[bend.entries[pair]]; // symmetric
                entry.lower += pairs[pair], entry.upper += pairs[pair];
            }
        }
    }

    void add(const AngleRow<D>& bend, double torque) {
        for (std::size_t i = 0, pair = 0; i < bend.arity; ++i) {
            auto& at = node(bend.nodes[i]);
            at.residual -= bend.along[i] * torque;
            at.diagonal += outer(bend.along[i] * bend.stiffness, bend.gradient[i]);
            for (std::size_t j = i + 1; j < bend.arity; ++j, ++pair) {
                if (bend.entries[pair] == Blocks<D>::none) continue;
                const bool in_order = bend.nodes[i] < bend.nodes[j];
                const auto early = in_order ? i : j, late = in_order ? j : i;
                auto& entry = blocks_.entries[bend.entries[pair]];
                entry.lower += outer(bend.along[late] * bend.stiffness, bend.gradient[early]);
                entry.upper += outer(bend.along[early] * bend.stiffness, bend.gradient[late]);
            }
        }
    }
};

} // namespace sinew::detail

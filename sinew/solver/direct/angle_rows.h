#pragma once

#include "sinew/constraint/angle.h"
#include "sinew/constraint/volume.h"
#include "sinew/solver/direct/matrices.h"
#include "sinew/solver/direct/rule.h"
#include "sinew/solver/project.h"

/// Angles of a block: rigid between their limits, springs and motors; the folds of 3D joints alike.
namespace sinew::detail {

template <int D> class BlockBends {
  public:
    BlockBends(Blocks<D>& blocks, const Block& block, double substep) : blocks_(blocks), block_(block), h_(substep) {}

    std::span<AngleRow<D>> all() const { return std::span(blocks_.bends).subspan(block_.first_bend, block_.bends); }

    /// Chooses the active limits at the start of the substep. If limits `bounce` (direct/joint_stops.h), only limits on
    /// which a joint rests are active.
    void set_out(bool bounce) {
        bounce_ = bounce;
        for (auto& bend : all()) {
            bend.flips = bend.doubts = 0;
            bend.slips = false;
            bend.give = 0;
            const double angle = bend.begun = angle_of(bend, true);
            bend.taut = tautness(bend, true);
            if (bounces(bend)) {
                constexpr double hardly = 1e-6;
                bend.side = bend.tension > 0 && angle > bend.high - hardly  ? 1
                            : bend.tension < 0 && angle < bend.low + hardly ? -1
                                                                            : 0;
                if (bend.side != 0) bend.give = maximum(beyond(bend, angle), 0.0);
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
        for (auto& bend : all()) worst = maximum(worst, assemble(bend, rule, hardest, margin));
        return worst;
    }

    /// Adds held angles to equations of the response to impulses: equalities and, if `limits`, loaded limits.
    void stiffen(bool limits, double hardest) {
        for (auto& bend : all()) {
            if (soft(bend) || bend.slips || (bend.one_sided() && !(limits && bend.tension * bend.side > 0))) continue;
            measure(bend);
            bend.along = bend.gradient;
            bend.stiffness = hardest * arm2(bend);
            add(bend, 0);
        }
    }

    double worst_error() const {
        double worst = 0;
        for (const auto& bend : all()) {
            if (soft(bend)) continue;
            const double angle = angle_of(bend, false);
            if (bend.side != 0)
                worst = maximum(worst, absolute(beyond(bend, angle) - bend.give));
            else if (!bounces(bend))
                worst = maximum(worst, maximum(angle - bend.high, bend.low - angle));
        }
        return worst;
    }

    /// Excess over the active limit, positive outside.
    static double beyond(const AngleRow<D>& bend, double angle) {
        return bend.side > 0 ? angle - bend.high : bend.low - angle;
    }

    /// True for a limit that a joint can reach, and leaves at the speed of arrival.
    bool bounces(const AngleRow<D>& bend) const {
        return bounce_ && bend.one_sided() && !soft(bend) && !bend.motorized;
    }

    /// First-order change of the angle in the last move.
    double change(const AngleRow<D>& bend) const {
        double turn = 0;
        for (std::size_t k = 0; k < bend.arity; ++k) turn += dot(bend.gradient[k], node(bend.nodes[k]).move);
        return turn;
    }

    double angle_of(const AngleRow<D>& bend, bool at_start) const {
        const auto place = [&](std::size_t k) {
            const auto& at = node(bend.nodes[k]);
            return at_start ? at.start : at.place;
        };
        if constexpr (D == 3)
            if (bend.is_fold())
                return Volume<3>::evaluate(Points<4, 3, double>{place(0), place(1), place(2), place(3)}).value /
                       bend.unit;
        const Points<3, D, double> points{place(0), place(1), place(2)};
        return unwrap<Angle<D>>(Angle<D>::evaluate(points).value, bend.low, bend.high);
    }

    double stored(const AngleRow<D>& bend, bool at_start) const {
        if (!soft(bend)) return 0;
        const double angle = angle_of(bend, at_start);
        return 0.5 * tautness(bend, at_start) * square(angle - clamp(angle, bend.low, bend.high)) / bend.compliance;
    }

    /// Disables springs from now on, or enables them.
    void disable_springs(bool limp) { limp_ = limp; }

    /// Largest violation of a rigid limit at the start of the substep.
    double worst_outside() const {
        double worst = 0;
        for (const auto& bend : all()) {
            if (soft(bend) || !bend.one_sided()) continue;
            const double angle = angle_of(bend, true);
            worst = maximum(worst, maximum(angle - bend.high, bend.low - angle));
        }
        return worst;
    }

    /// Largest volume of a flat square, as a fraction of `unit`.
    double worst_warp(bool at_start) const {
        double worst = 0;
        for (const auto& bend : all())
            if (bend.replaces_link) worst = maximum(worst, absolute(angle_of(bend, at_start)));
        return worst;
    }

    bool any_struck() const {
        for (const auto& bend : all())
            if (bend.side != 0 && bend.one_sided() && !soft(bend) && !bounces(bend)) return true;
        return false;
    }

    /// Largest overshoot of a bouncing angle past the limit, and past the angle at the start of the substep.
    double worst_overshoot() const {
        double worst = 0;
        for (const auto& bend : all()) {
            if (bend.side != 0 || !bounces(bend)) continue;
            const double angle = angle_of(bend, false);
            worst =
                maximum(worst, maximum(angle - maximum(bend.high, bend.begun), minimum(bend.low, bend.begun) - angle));
        }
        return worst;
    }

    static bool soft(const AngleRow<D>& bend) { return bend.compliance > 0; }

    // --- velocities

    /// Rate of change of an angle, relative to the limits.
    double rate_of(const AngleRow<D>& bend) const {
        double rate = -bend.motor_speed;
        for (std::size_t k = 0; k < bend.arity; ++k) rate += dot(bend.gradient[k], node(bend.nodes[k]).velocity);
        return rate;
    }
    double rate_at_end(AngleRow<D>& bend) const {
        measure(bend);
        return rate_of(bend);
    }
    void begin_settling() {
        for (auto& bend : all()) bend.pull = 0, measure(bend), bend.along = bend.gradient;
    }
    void project_velocities(double stiffness) {
        for (auto& bend : all()) {
            const double rate = rate_of(bend);
            const double k = stiffness * arm2(bend);
            const double pull = bend.pull + k * rate;
            const bool resists =
                bend.side != 0 && !soft(bend) && !bend.slips && (!bend.one_sided() || pull * bend.side > 0);
            bend.stiffness = resists ? k : 0;
            if (resists) add(bend, bend.pull = pull);
        }
    }
    void end_round() {
        for (auto& bend : all())
            if (bend.stiffness > 0) bend.pull += bend.stiffness * change(bend);
    }

  private:
    Blocks<D>& blocks_;
    const Block& block_;
    double h_;
    bool bounce_ = false, limp_ = false;

    BlockNode<D>& node(std::uint32_t i) const { return blocks_.nodes[i]; }

    /// Fraction of a spring's stiffness that acts, 0..1: springs bend taut arms only, since an arm of no length could
    /// be turned by nothing.
    double tautness(const AngleRow<D>& bend, bool at_start) const {
        double share = 1;
        for (std::size_t i = 0; i < 2; ++i) {
            if (bend.arms[i] == 0) continue;
            const auto &a = node(bend.nodes[i]), &b = node(bend.nodes[i + 1]);
            const auto arm = at_start ? b.start - a.start : b.place - a.place;
            share *= minimum(dot(arm, arm) / bend.arms[i], 1.0);
        }
        return share;
    }

    /// Angle of a spring, continued past half a turn within a substep, where the torque must not change sign.
    static double turned_on(const AngleRow<D>& bend, double angle) {
        return bend.begun + unwrap<Angle<D>>(angle - bend.begun, 0.0, 0.0);
    }

    double measure(AngleRow<D>& bend) const {
        if constexpr (D == 3)
            if (bend.is_fold()) return measure_fold(bend);
        const Points<3, D, double> points{node(bend.nodes[0]).place, node(bend.nodes[1]).place,
                                          node(bend.nodes[2]).place};
        const auto evaluated = Angle<D>::evaluate(points);
        for (std::size_t k = 0; k < 3; ++k) bend.gradient[k] = gentle<Angle<D>>(evaluated.gradient[k]);
        return unwrap<Angle<D>>(evaluated.value, bend.low, bend.high);
    }

    double measure_fold(AngleRow<D>& bend) const requires(D == 3) {
        const auto place = [&](std::size_t k) { return node(bend.nodes[k]).place; };
        const auto evaluated = Volume<3>::evaluate(Points<4, 3, double>{place(0), place(1), place(2), place(3)});
        for (std::size_t k = 0; k < 4; ++k) bend.gradient[k] = evaluated.gradient[k] * (1 / bend.unit);
        return evaluated.value / bend.unit;
    }

    /// Discrete gradient of a volume: the mean over the substep, exact since a volume is linear in each edge u, v, w:
    ///
    ///     du = (2 v0 x w0 + v0 x w1 + v1 x w0 + 2 v1 x w1) / 36
    void point_fold(AngleRow<D>& bend) const requires(D == 3) {
        const auto& a = node(bend.nodes[0]);
        const auto mean = [&](std::size_t i, std::size_t j) {
            const auto &b = node(bend.nodes[i]), &c = node(bend.nodes[j]);
            const auto v0 = b.start - a.start, w0 = c.start - a.start, v1 = b.place - a.place, w1 = c.place - a.place;
            return (cross(v0 * 2 + v1, w0) + cross(v1 * 2 + v0, w1)) * (1 / (36 * bend.unit));
        };
        const auto db = mean(2, 3), dc = mean(3, 1), dd = mean(1, 2);
        bend.along = {-(db + dc + dd), db, dc, dd};
    }

    /// Direction of the force. In a midpoint step, the discrete gradient: the work over the substep is torque times
    /// turn. The angle is that of (u . v, u x v), both bilinear, with discrete gradients at the means of u and v;
    /// between two points of a circle of radius r, turned by t about the middle angle m, the discrete gradient is
    ///
    ///     (-sin m, cos m)  (t/2) / (r sin(t/2))
    ///
    /// In space u x v has no sign, and u . v alone will do.
    void point(AngleRow<D>& bend, Rule rule, double angle) const {
        bend.along = bend.gradient;
        if (rule != Rule::swing || soft(bend)) return;
        if constexpr (D == 3)
            if (bend.is_fold()) return point_fold(bend);
        const auto &a = node(bend.nodes[0]), &b = node(bend.nodes[1]), &c = node(bend.nodes[2]);
        const auto u0 = b.start - a.start, v0 = c.start - b.start, u1 = b.place - a.place, v1 = c.place - b.place;
        const auto u = (u0 + u1) * 0.5, v = (v0 + v1) * 0.5;
        const double r2 = square_root(dot(u0, u0) * dot(v0, v0)) * square_root(dot(u1, u1) * dot(v1, v1));
        const double half = 0.5 * (angle - bend.begun), middle = bend.begun + half;
        constexpr double small = 1e-4, large = 1;
        if (!(r2 > 0) || absolute(half) > large) return;
        const double scale = (absolute(half) < small ? 1 : half / sine(half)) / square_root(r2);
        if constexpr (D == 2) {
            const double along = -sine(middle) * scale, across = cosine(middle) * scale;
            const auto du = v * along - perpendicular(v) * across, dv = u * along + perpendicular(u) * across;
            bend.along = {-du, du - dv, dv};
        } else {
            constexpr double straight = 1e-3;
            const double s = sine(middle);
            if (!(s > straight)) return;
            const auto du = v * (-scale / s), dv = u * (-scale / s);
            bend.along = {-du, du - dv, dv};
        }
    }

    /// Squared lever arm of an angle, m^2: makes an angle as stiff as a link of that length.
    static double arm2(const AngleRow<D>& bend) {
        double steepest = 0;
        for (std::size_t k = 0; k < bend.arity; ++k)
            steepest = maximum(steepest, dot(bend.gradient[k], bend.gradient[k]));
        return inverse_or_zero(steepest);
    }

    /// Adds one angle to the equations; returns the violation of a limit.
    double assemble(AngleRow<D>& bend, Rule rule, double hardest, double margin) {
        double angle = measure(bend);
        if (soft(bend)) angle = turned_on(bend, angle);
        point(bend, rule, angle);
        bend.stiffness = 0;
        if (rule == Rule::place && bend.motorized) return 0; // no time passes: a motor yields
        if (soft(bend)) {
            const double error = angle - clamp(angle, bend.low, bend.high);
            if (limp_) bend.tension = 0;
            if (error == 0 || rule == Rule::place || limp_) return 0;
            const double k = minimum(bend.taut / bend.compliance, hardest * arm2(bend));
            bend.tension = bend.held(k * (error + bend.damping_time * ((angle - bend.begun) / h_ - bend.motor_speed)),
                                     bend.tension, false);
            bend.stiffness = bend.slips ? 0 : k * (1 + bend.damping_time / h_);
            add(bend, bend.tension);
            return 0;
        }
        if (bend.side == 0 && !bounces(bend)) bend.activate(angle - bend.high, angle - bend.low, margin);
        if (bend.side == 0) return 0;
        const double error = bend.side * (beyond(bend, angle) - bend.give);
        bend.stiffness = hardest * arm2(bend);
        bend.pull = bend.held(bend.tension + bend.stiffness * error, bend.tension, false);
        if (bend.slips) bend.stiffness = 0;
        add(bend, bend.pull);
        return bend.slips ? 0 : absolute(error);
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

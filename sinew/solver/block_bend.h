#pragma once

#include "sinew/constraint/angle.h"
#include "sinew/solver/block_matrix.h"
#include "sinew/solver/block_rule.h"
#include "sinew/solver/project.h"

/// Angles in a block: rigid ones between their limits, springs, motors.
namespace sinew::detail {

template <int D> class BlockBends {
  public:
    BlockBends(Blocks<D>& blocks, const Block& block, double substep) : blocks_(blocks), block_(block), h_(substep) {}

    std::span<BlockBend<D>> all() const { return std::span(blocks_.bends).subspan(block_.first_bend, block_.bends); }

    void set_out() {
        for (auto& bend : all()) {
            bend.flips = 0;
            const double angle = bend.begun = angle_of(bend, true);
            bend.slips = false, bend.doubts = 0;
            const bool exact = !bend.one_sided();
            bend.side = exact || bend.tension > 0 || angle > bend.high ? 1
                        : bend.tension < 0 || angle < bend.low         ? -1
                                                                       : 0;
        }
    }

    /// Adds all to the equations; returns how far the worst is outside its limits.
    double assemble(Rule rule, double hardest, double margin) {
        double worst = 0;
        for (auto& bend : all()) worst = maximum(worst, assemble(bend, rule, hardest, margin));
        return worst;
    }

    double worst_error() const {
        double worst = 0;
        for (const auto& bend : all()) {
            if (soft(bend)) continue;
            const double angle = angle_of(bend, false);
            worst = maximum(worst, bend.outside(angle - bend.high, angle - bend.low));
        }
        return worst;
    }

    /// How much the last move turned it, to first order.
    double change(const BlockBend<D>& bend) const {
        double turn = 0;
        for (std::size_t k = 0; k < 3; ++k) turn += dot(bend.gradient[k], node(bend.nodes[k]).move);
        return turn;
    }

    double angle_of(const BlockBend<D>& bend, bool at_start) const {
        const auto place = [&](std::size_t k) {
            const auto& at = node(bend.nodes[k]);
            return at_start ? at.start : at.place;
        };
        const Points<3, D, double> points{place(0), place(1), place(2)};
        return unwrap<Angle<D>>(Angle<D>::evaluate(points).value, bend.low, bend.high);
    }

    double stored(const BlockBend<D>& bend, bool at_start) const {
        if (!soft(bend)) return 0;
        const double angle = angle_of(bend, at_start);
        return 0.5 * square(angle - clamp(angle, bend.low, bend.high)) / bend.compliance;
    }

    bool any_struck() const {
        for (const auto& bend : all())
            if (bend.side != 0 && bend.one_sided() && !soft(bend)) return true;
        return false;
    }

    static bool soft(const BlockBend<D>& bend) { return bend.compliance > 0; }

    // --- velocities

    void begin_settling() {
        for (auto& bend : all()) bend.pull = 0, measure(bend);
    }
    void settle(double stiffness) {
        for (auto& bend : all()) {
            double rate = -bend.rate;
            for (std::size_t k = 0; k < 3; ++k) rate += dot(bend.gradient[k], node(bend.nodes[k]).velocity);
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

    BlockNode<D>& node(std::uint32_t i) const { return blocks_.nodes[i]; }

    double measure(BlockBend<D>& bend) const {
        const Points<3, D, double> points{node(bend.nodes[0]).place, node(bend.nodes[1]).place,
                                          node(bend.nodes[2]).place};
        const auto evaluated = Angle<D>::evaluate(points);
        for (std::size_t k = 0; k < 3; ++k) bend.gradient[k] = gentle<Angle<D>>(evaluated.gradient[k]);
        return unwrap<Angle<D>>(evaluated.value, bend.low, bend.high);
    }

    /// The square of an angle's lever: an angle as stiff as a link of that length.
    static double arm2(const BlockBend<D>& bend) {
        double steepest = 0;
        for (const auto& gradient : bend.gradient) steepest = maximum(steepest, dot(gradient, gradient));
        return inverse_or_zero(steepest);
    }

    /// Returns how far the angle is outside its limits.
    double assemble(BlockBend<D>& bend, Rule rule, double hardest, double margin) {
        const double angle = measure(bend);
        bend.stiffness = 0;
        if (rule == Rule::place && bend.driven) return 0; // no time passes: it gives
        if (soft(bend)) {
            const double error = angle - clamp(angle, bend.low, bend.high);
            if (error == 0 || rule == Rule::place) return 0;
            const double k = minimum(1 / bend.compliance, hardest * arm2(bend));
            bend.tension =
                bend.held(k * (error + bend.lead * ((angle - bend.begun) / h_ - bend.rate)), bend.tension, false);
            bend.stiffness = bend.slips ? 0 : k * (1 + bend.lead / h_);
            add(bend, bend.tension);
            return 0;
        }
        const double above = angle - bend.high, below = angle - bend.low;
        if (bend.side == 0) bend.come_to_a_limit(above, below, margin);
        if (bend.side == 0) return 0;
        const double error = bend.side > 0 ? above : below;
        bend.stiffness = hardest * arm2(bend);
        bend.pull = bend.held(bend.tension + bend.stiffness * error, bend.tension, false);
        if (bend.slips) bend.stiffness = 0;
        add(bend, bend.pull);
        return bend.slips ? 0 : absolute(error);
    }

    void add(const BlockBend<D>& bend, double torque) {
        for (std::size_t i = 0; i < 3; ++i) {
            auto& at = node(bend.nodes[i]);
            const auto& gradient = bend.gradient[i];
            at.residual -= gradient * torque;
            at.diagonal += outer(gradient * bend.stiffness, gradient);
            if (bend.entries[i] == Blocks<D>::none) continue;
            const auto j = (i + 1) % 3;
            const auto& other = bend.gradient[j];
            const bool in_order = bend.nodes[i] < bend.nodes[j];
            const auto &early = in_order ? gradient : other, &late = in_order ? other : gradient;
            blocks_.entries[bend.entries[i]].lower += outer(late * bend.stiffness, early);
            blocks_.entries[bend.entries[i]].upper += outer(early * bend.stiffness, late);
        }
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/solver/block.h"
#include "sinew/solver/direct/matrices.h"
#include "sinew/solver/direct/rule.h"

namespace sinew::detail {

/// Distances of a block: rigid links between their limits, and springs.
template <int D> class DistanceRows {
  public:
    using Vector = Vec<D, double>;

    /// `stiffness`: penalty stiffness of a rigid link of length 1.
    DistanceRows(Blocks<D>& blocks, const Block& block, double stiffness)
        : blocks_(blocks), block_(block), stiffness_(stiffness) {}

    std::span<DistanceRow<D>> all() const { return std::span(blocks_.links).subspan(block_.first_link, block_.links); }
    double stiffness() const { return stiffness_; }

    /// Fits penalties to light trees from now on (direct/light_trees.h).
    void use_shares() { uses_shares_ = true; }
    bool uses_shares() const { return uses_shares_; }
    /// The link of maximum length that pushes most; null if none does.
    DistanceRow<D>* strongest_push(double slight) {
        DistanceRow<D>* strongest = nullptr;
        double most = 0;
        for (auto& link : all()) {
            if (!link.one_sided() || soft(link)) continue;
            const double push = -link.tension * link.side;
            if (push > slight * share(link) && push * link.length > most) most = push * link.length, strongest = &link;
        }
        return strongest;
    }

    /// Penalty stiffness of one rigid link, relative to `stiffness()`: the mass that the link moves, relative to all.
    double share(const DistanceRow<D>& link) const { return uses_shares_ ? link.share : 1; }

    /// True for a spring; stiffer than the penalty counts as rigid.
    bool soft(const DistanceRow<D>& link) const { return link.is_softer_than(stiffness_); }

    /// True for a joint's range that a link can leave, and comes back from at the speed of arrival.
    bool bounces(const DistanceRow<D>& link) const { return bounce_ && link.is_range() && !soft(link); }

    /// Chooses the active limits at the start of the substep; returns the total length. If ranges `bounce`
    /// (direct/joint_stops.h), only limits on which a link rests are active.
    double set_out(bool bounce, double tautness) {
        bounce_ = bounce;
        double total_length = 0;
        for (auto& link : all()) {
            link.start = node(link.b).start - node(link.a).start;
            total_length += link.length;
            choose_side(link, tautness);
        }
        return total_length;
    }

    /// Adds the rows of all links to the equations; returns the worst violation of a rigid link, relative to the
    /// length.
    double assemble(Rule rule, bool elastic, double margin) {
        double worst = 0;
        for (auto& link : all()) worst = max(worst, assemble(link, rule, elastic, margin));
        return worst;
    }

    /// Adds one row, with the force at the nodes.
    [[gnu::always_inline]] void add(const DistanceRow<D>& link, const Matrix<D, double>& stiffness,
                                    const Vector& force) {
        auto &a = node(link.a), &b = node(link.b);
        a.diagonal += stiffness;
        b.diagonal += stiffness;
        if (link.entry != Blocks<D>::none) {
            blocks_.entries[link.entry].lower -= stiffness;
            blocks_.entries[link.entry].upper -= stiffness;
        }
        a.residual += force;
        b.residual -= force;
    }

    /// Worst violation of a rigid link at the present positions, scaled as in `assemble`.
    double worst_error() const {
        double worst = 0;
        for (const auto& link : all()) {
            if (soft(link) || (link.side == 0 && bounces(link))) continue;
            const auto now = node(link.b).position - node(link.a).position;
            const double length2 = dot(now, now) - 2 * link.give;
            const double above = length2 - square(link.high), below = length2 - square(link.low);
            worst = max(worst, 0.5 * link.outside(above, below) * link.per_length2);
        }
        return worst;
    }

    /// Worst violation of a rigid link, as Green strain, at the positions at(node).
    template <class At> double worst_strain(At&& at) const {
        double worst = 0;
        for (const auto& link : all()) {
            if (soft(link)) continue;
            const auto span = at(node(link.b)) - at(node(link.a));
            const double length2 = dot(span, span);
            const double error = max(length2 - square(link.high), square(link.low) - length2);
            worst = max(worst, 0.5 * error * link.per_length2);
        }
        return worst;
    }

    /// Largest overshoot of a bouncing link past the limit, and past the length at the start of the substep, as a
    /// fraction of half the length.
    double worst_overshoot() const {
        double worst = 0;
        for (const auto& link : all()) {
            if (link.side != 0 || !bounces(link)) continue;
            const double begun = norm(link.start), now = norm(node(link.b).position - node(link.a).position);
            const double beyond = max(now - max(link.high, begun), min(link.low, begun) - now);
            worst = max(worst, 2 * beyond / link.length);
        }
        return worst;
    }

    double stored(const DistanceRow<D>& link, const Vector& span) const {
        if (!soft(link)) return 0;
        return link.spring_energy(norm(span));
    }

    // --- velocities

    /// True if the velocities would change a length by more than a fraction `usual` in a time h.
    bool has_velocity_error(double usual, double h) const {
        for (const auto& link : all()) {
            if (soft(link) || (link.one_sided() && link.tension == 0)) continue;
            const auto span = node(link.b).position - node(link.a).position;
            const double rate = dot(span, node(link.b).velocity - node(link.a).velocity);
            if (absolute(rate) * h > usual * square(link.length)) return true;
        }
        return false;
    }
    void begin_settling() {
        for (auto& link : all()) link.pull = 0;
    }
    void project_velocities(double hardest) {
        for (auto& link : all()) {
            link.along = node(link.b).position - node(link.a).position;
            const double k = hardest * link.per_length2 * share(link);
            const double rate = dot(link.along, node(link.b).velocity - node(link.a).velocity);
            const double pull = link.pull + k * rate;
            const bool resists = !link.one_sided() || (link.tension > 0 && pull > 0) || (link.tension < 0 && pull < 0);
            link.stiffness = resists && !soft(link) ? k : 0;
            if (link.stiffness == 0) continue;
            link.pull = pull;
            add(link, outer(link.along * k, link.along), link.along * pull);
        }
    }
    void end_round() {
        for (auto& link : all())
            if (link.stiffness > 0)
                link.pull += link.stiffness * dot(link.along, node(link.b).displacement - node(link.a).displacement);
    }

  private:
    Blocks<D>& blocks_;
    const Block& block_;
    double stiffness_;
    bool bounce_ = false, uses_shares_ = false;

    BlockNode<D>& node(std::uint32_t i) const { return blocks_.nodes[i]; }

    /// Active limit at the start of the substep. A link within the margin of a limit counts as taut: a falling rope
    /// would otherwise tighten link by link.
    void choose_side(DistanceRow<D>& link, double tautness) const {
        link.flips = 0;
        link.give = 0;
        if (bounces(link)) return rest_on_end(link);
        link.side = link.low == link.high || link.tension > 0 ? 1 : link.tension < 0 ? -1 : 0;
        if (link.side != 0) return;
        const double length = norm(link.start), margin = tautness * link.length;
        link.side = length > link.high - margin ? 1 : length < link.low + margin ? -1 : 0;
    }

    /// For a bouncing link: only the limit on which the link rests is active, offset by the present excess.
    static void rest_on_end(DistanceRow<D>& link) {
        constexpr double hardly_short = 1e-6;
        const double length2 = dot(link.start, link.start), margin = hardly_short * square(link.length);
        const double above = 0.5 * (length2 - square(link.high)), below = 0.5 * (length2 - square(link.low));
        link.side = link.tension > 0 && above > -margin ? 1 : link.tension < 0 && below < margin ? -1 : 0;
        link.give = link.side > 0 ? max(above, 0.0) : link.side < 0 ? min(below, 0.0) : 0;
    }

    double assemble(DistanceRow<D>& link, Rule rule, bool elastic, double margin) {
        const auto now = node(link.b).position - node(link.a).position;
        if (soft(link)) {
            spring(rule, link, now);
            return 0;
        }
        const double k = stiffness_ * link.per_length2 * share(link);
        const double length2 = dot(now, now);
        const double above = 0.5 * (length2 - square(link.high)), below = 0.5 * (length2 - square(link.low));
        if (link.side == 0 && !bounces(link)) link.activate(above, below, margin * square(link.length));
        const double error = (link.side > 0 ? above : link.side < 0 ? below : 0) - link.give;
        link.pull = link.side != 0 ? link.tension + k * error : 0;
        link.stiffness = link.side != 0 ? k : 0;
        if (link.side != 0) add_rigid(link, rule, now, elastic ? link.pull : link.tension);
        return absolute(error) * link.per_length2;
    }

    /// Row of a rigid link, with the geometric stiffness of a tension.
    void add_rigid(DistanceRow<D>& link, Rule rule, const Vector& now, double tension) {
        const bool is_midpoint = rule == Rule::midpoint;
        const auto along = is_midpoint ? (link.start + now) * 0.5 : rule == Rule::shake ? link.start : now;
        link.along = now;
        auto matrix = outer(along * link.stiffness, now);
        if (rule != Rule::static_projection && rule != Rule::shake)
            matrix += Matrix<D, double>::diagonal(max(tension, 0.0) * (is_midpoint ? 0.5 : 1));
        add(link, matrix, along * link.pull);
    }

    /// A compliant link: the force follows from the length, without a multiplier.
    void spring(Rule rule, DistanceRow<D>& link, const Vector& now) {
        const double length = norm(now), per_length = inverse_or_zero(length);
        const double error = link.error_of(length);
        link.stiffness = 0;
        link.pull = link.tension = 0;
        if (error == 0 || rule == Rule::static_projection) return;
        const double k = link.spring_stiffness();
        double force = k * error;
        auto along = now * per_length;
        auto matrix = outer(along * k, along);
        matrix += Matrix<D, double>::diagonal(max(force, 0.0) * per_length);
        add(link, matrix, along * force);
        link.pull = link.tension = force * per_length;
    }
};

} // namespace sinew::detail

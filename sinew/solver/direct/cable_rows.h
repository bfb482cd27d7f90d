#pragma once

#include "sinew/solver/direct/cable_geometry.h"
#include "sinew/solver/direct/matrices.h"

/// Cables of a block: ropes running freely over some nodes, with limits on the total length (Pulley); and distances
/// with a motor or a largest force. As for links, each leg pulls along the mean of its old and new directions, so the
/// work is tension times the change of length.
namespace sinew::detail {

template <int D> class CableRows {
  public:
    using Vector = Vec<D, double>;
    using Entry = Matrix<D, double>;

    CableRows(Blocks<D>& blocks, const Block& block, double substep)
        : blocks_(blocks), block_(block), geometry_(blocks), h_(substep) {}

    std::span<CableRow> all() const { return std::span(blocks_.ways).subspan(block_.first_way, block_.ways); }
    const CableGeometry<D>& geometry() const { return geometry_; }

    /// Starts a substep; returns the total length of all cables.
    double set_out(double tautness) {
        double total_length = 0;
        for (auto& way : all()) {
            double length = 0;
            const auto on = geometry_.nodes(way);
            for (std::size_t i = 0; i + 1 < on.size(); ++i) {
                on[i].start = geometry_.node(on[i + 1]).start - geometry_.node(on[i]).start;
                length += norm(on[i].start);
            }
            total_length += length;
            way.flips = way.doubts = 0;
            way.slips = false;
            const double margin = tautness * length;
            const bool exact = !way.one_sided();
            if (exact || way.tension > 0 || (way.tension == 0 && length > way.high - margin))
                way.side = 1;
            else
                way.side = way.tension < 0 || length < way.low + margin ? -1 : 0;
        }
        return total_length;
    }

    /// Adds the rows of all cables to the equations; returns the worst relative violation.
    double assemble(Rule rule, double hardest, bool elastic, double margin) {
        double worst = 0;
        for (auto& way : all()) worst = max(worst, assemble(way, rule, hardest, elastic, margin));
        return worst;
    }

    double stored(const CableRow& way, bool at_start) const {
        if (!way.is_compliant()) return 0;
        return way.spring_energy(geometry_.length_of(way, at_start));
    }

    /// Largest change of a leg by the last move, squared, relative to the leg or to a tenth of the cable if longer.
    double largest_change2() const {
        double largest = 0;
        for (const auto& way : all()) {
            const auto on = geometry_.nodes(way);
            for (std::size_t i = 0; i + 1 < on.size(); ++i) {
                const auto leg = geometry_.node(on[i + 1]).position - geometry_.node(on[i]).position;
                const auto change = geometry_.node(on[i + 1]).displacement - geometry_.node(on[i]).displacement;
                largest =
                    max(largest, dot(change, change) * inverse_or_zero(max(dot(leg, leg), square(0.1 * way.length))));
            }
        }
        return largest;
    }

    /// Worst relative violation of a rigid cable without a motor.
    double worst_strain(bool at_start) const {
        double worst = 0;
        for (const auto& way : all()) {
            if (way.is_compliant() || way.motorized) continue;
            const double length = geometry_.length_of(way, at_start);
            worst = max(worst, absolute(way.error_of(length)) / max(length, 1e-6));
        }
        return worst;
    }

    // --- velocities

    /// True if the velocities would change lengths otherwise than the limits, in a time h.
    bool has_velocity_error(double usual, double h) const {
        for (const auto& way : all()) {
            if (way.is_compliant() || way.slips || (way.one_sided() && way.tension == 0)) continue;
            geometry_.point(way);
            constexpr double driven = 1e-5;
            if (absolute(geometry_.lengthening(way)) * h > (way.motorized ? driven : usual) * way.high) return true;
        }
        return false;
    }
    void begin_settling() {
        for (auto& way : all()) way.pull = 0, geometry_.point(way);
    }
    void project_velocities(double k) {
        for (auto& way : all()) {
            const double pull = way.pull + k * geometry_.lengthening(way);
            const bool tightened = way.before == 0 && way.tension != 0; // no bounce
            const bool resists = !way.one_sided() || tightened || pull * way.tension > 0;
            way.stiffness = resists && !way.is_compliant() && !way.slips ? k : 0;
            if (way.stiffness > 0) add(way, way.stiffness, way.pull = pull);
        }
    }
    void end_round() {
        for (auto& way : all())
            if (way.stiffness > 0) way.pull += way.stiffness * geometry_.change(way);
    }

  private:
    Blocks<D>& blocks_;
    const Block& block_;
    CableGeometry<D> geometry_;
    double h_;

    double assemble(CableRow& way, Rule rule, double hardest, bool elastic, double margin) {
        geometry_.measure(way, rule);
        way.stiffness = 0;
        const bool stiff = !way.is_compliant();
        if (rule == Rule::static_projection && (!stiff || way.motorized))
            return 0; // no time passes: springs and motors yield
        if (!stiff) {
            spring(way, rule, hardest);
            return 0;
        }
        const double above = way.length - way.high, below = way.length - way.low;
        if (way.side == 0 && (above > margin * way.length || below < -margin * way.length)) {
            way.side = above > 0 ? 1 : -1;
            ++way.flips;
        }
        way.pull = 0;
        if (way.side == 0) return 0;
        const double error = way.side > 0 ? above : below;
        way.pull = way.held(way.tension + hardest * error, way.tension, way.one_sided() && way.side > 0);
        way.stiffness = way.slips ? 0 : hardest;
        add(way, way.stiffness, way.pull);
        if (rule != Rule::static_projection) add_geometric(way, rule, max(elastic ? way.pull : way.tension, 0.0));
        return way.slips ? 0 : absolute(error) / max(way.length, 1e-6);
    }

    void spring(CableRow& way, Rule rule, double hardest) {
        const double error = way.error_of(way.length);
        const double last = way.tension;
        way.tension = 0;
        if (error == 0) return;
        const double k = way.spring_stiffness(hardest);
        const double moved = (way.length - geometry_.length_of(way, true)) / h_ - way.motor_speed;
        way.tension = way.held(k * (error + way.damping_time * moved), last, way.one_sided() && error > 0);
        way.stiffness = way.slips ? 0 : k * (1 + way.damping_time / h_);
        add(way, way.stiffness, way.tension);
        add_geometric(way, rule, max(way.tension, 0.0));
    }

    void add(const CableRow& way, double stiffness, double pull) {
        const auto on = geometry_.nodes(way);
        auto entry = way.first_entry;
        for (std::size_t i = 0; i < on.size(); ++i) {
            auto& at = geometry_.node(on[i]);
            at.residual -= on[i].along * pull;
            at.diagonal += outer(on[i].along * stiffness, on[i].gradient);
            for (std::size_t j = i + 1; j < on.size(); ++j, ++entry) {
                const auto e = blocks_.way_entries[entry];
                if (e == Blocks<D>::none) continue;
                const bool in_order = on[i].node < on[j].node;
                const auto &early = in_order ? on[i] : on[j], &late = in_order ? on[j] : on[i];
                blocks_.entries[e].lower += outer(late.along * stiffness, early.gradient);
                blocks_.entries[e].upper += outer(early.along * stiffness, late.gradient);
            }
        }
    }

    /// Geometric stiffness: a leg under tension resists rotation.
    void add_geometric(const CableRow& way, Rule rule, double tension) {
        const auto on = geometry_.nodes(way);
        auto entry = way.first_entry;
        for (std::size_t i = 0; i + 1 < on.size(); entry += std::uint32_t(on.size() - 1 - i), ++i) {
            const auto leg = geometry_.node(on[i + 1]).position - geometry_.node(on[i]).position;
            const double length = norm(leg);
            const double span = rule == Rule::midpoint ? length + norm(on[i].start) : length;
            if (!(length > 1e-9 * way.length)) continue;
            const auto n = leg * (1 / length);
            auto turn = Entry::diagonal(tension / span);
            turn -= outer(n * (tension / span), n);
            geometry_.node(on[i]).diagonal += turn;
            geometry_.node(on[i + 1]).diagonal += turn;
            const auto e = blocks_.way_entries[entry];
            if (e == Blocks<D>::none) continue;
            blocks_.entries[e].lower -= turn;
            blocks_.entries[e].upper -= turn;
        }
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/solver/block.h"
#include "sinew/solver/direct/rule.h"

namespace sinew::detail {

/// Cables at the positions of the nodes: lengths, gradients, and directions of pull.
template <int D> class CableGeometry {
  public:
    explicit CableGeometry(Blocks<D>& blocks) : blocks_(blocks) {}

    std::span<CableNode<D>> nodes(const CableRow& way) const {
        return std::span(blocks_.way_nodes).subspan(way.first, way.nodes);
    }
    BlockNode<D>& node(const CableNode<D>& on) const { return blocks_.nodes[on.node]; }

    double length_of(const CableRow& way, bool at_start) const {
        double sum = 0;
        const auto on = nodes(way);
        const auto position = [&](std::size_t i) { return at_start ? node(on[i]).start : node(on[i]).position; };
        for (std::size_t i = 0; i + 1 < on.size(); ++i) sum += norm(position(i + 1) - position(i));
        return sum;
    }

    /// Gradient of the length at the present positions.
    void point(const CableRow& way) const {
        const auto on = nodes(way);
        for (auto& at : on) at.gradient = {};
        for (std::size_t i = 0; i + 1 < on.size(); ++i) {
            const auto n = direction(node(on[i + 1]).position - node(on[i]).position);
            on[i].gradient -= n;
            on[i + 1].gradient += n;
        }
        for (auto& at : on) at.along = at.gradient;
    }

    /// Length, gradient, and directions of pull.
    void measure(CableRow& way, Rule rule) const {
        const auto on = nodes(way);
        for (auto& at : on) at.gradient = at.along = {};
        way.length = 0;
        for (std::size_t i = 0; i + 1 < on.size(); ++i) {
            const auto leg = node(on[i + 1]).position - node(on[i]).position;
            const double length = norm(leg);
            way.length += length;
            const auto n = leg * inverse_or_zero(length);
            const auto mean =
                rule == Rule::midpoint ? (leg + on[i].start) * inverse_or_zero(length + norm(on[i].start)) : n;
            on[i].gradient -= n;
            on[i + 1].gradient += n;
            on[i].along -= mean;
            on[i + 1].along += mean;
        }
    }

    /// Change of a cable's length by the last move, to first order.
    double change(const CableRow& way) const {
        double sum = 0;
        for (const auto& on : nodes(way)) sum += dot(on.gradient, node(on).displacement);
        return sum;
    }

    /// Rate of change of a cable's length, relative to the limits.
    double lengthening(const CableRow& way) const {
        double rate = -way.motor_speed;
        for (const auto& on : nodes(way)) rate += dot(on.gradient, node(on).velocity);
        return rate;
    }

  private:
    Blocks<D>& blocks_;
};

} // namespace sinew::detail

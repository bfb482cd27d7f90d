#include "sinew/prefab/bridge.h"

namespace sinew {

Sizes Bridge::sizes() const {
    const auto n = std::size_t(planks);
    if (rail > 0) return {.particles = 2 * n + 2, .constraints = 3 * n - 1};
    return {.particles = n + 1, .constraints = n};
}

template <int D, class Real> void Bridge::build(Builder<D, Real>& figure) const {
    const double rope_share = rail > 0 ? 0.05 : 0; // share of the mass
    constexpr double rope_width = 0.3;             // share of the planks' thickness
    const double length = span * (1 + slack), plank = length / planks;
    Strand strand{.pieces = planks,
                  .length = length,
                  .angle = pi<double> / 2,
                  .slack = slack,
                  .mass = mass * (1 - rope_share),
                  .radius = thickness / 2,
                  .stem = "joint",
                  .first = "left_bank",
                  .last = "right_bank"};
    const auto joints = build_strand(figure, strand);
    link(figure, joints, {.limits = exactly(plank)}, "plank");
    hold_ends(figure, joints, "both");

    if (rail > 0) {
        strand.mass = rope_share * mass;
        strand.y = rail;
        strand.stem = "rail";
        strand.first = strand.last = "";
        auto rope = build_strand(figure, strand);
        link(figure, rope, {.limits = at_most(plank)}, "rail_link");
        figure.number_constraints("hanger", joints.size() - 2);
        for (std::size_t i = 1; i + 1 < joints.size(); ++i)
            figure.template constrain<Distance>("", {joints[i], rope[i]}, {.limits = at_most(rail)});
        hold_ends(figure, rope, "both");
        for (std::size_t i = 0; i < joints.size(); ++i)
            figure.draw(Mark::stroke, "hanger", {joints[i], rope[i]}, rope_width * thickness);
        figure.draw(Mark::curve, "rail", std::move(rope), rope_width * thickness);
    }
    for (std::size_t i = 0; i + 1 < joints.size(); ++i)
        figure.draw(Mark::stroke, "plank", {joints[i], joints[i + 1]}, thickness);
}

#define SINEW_BRIDGE(D, Real) template void Bridge::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_BRIDGE)

} // namespace sinew

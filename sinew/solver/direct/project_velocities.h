#pragma once

#include "sinew/solver/direct/equations.h"

namespace sinew::detail {

/// Projects the velocities of a block onto the motions that the constraints allow (n . v = 0 for each active one), with
/// the least change of momentum: `rounds` solves of an augmented Lagrangian. One-sided limits take part only while
/// loaded. `hold(stiffness)` adds external terms, such as planes, to the equations.
template <int D, class Hold> void project_block_velocities(BlockEquations<D>& block, Hold&& hold, int rounds = 3) {
    constexpr double relative = 1e3;
    const auto at = [&](std::uint32_t i) -> BlockNode<D>& { return block.node(i); };
    const double hardest = relative * block.total_mass();
    for (auto& link : block.links()) link.pull = 0;
    block.bends().begin_settling();
    block.ways().begin_settling();
    for (auto& node : block.nodes()) node.aim = node.velocity;
    for (int i = 0; i < rounds; ++i) {
        for (auto& node : block.unknowns()) {
            node.diagonal = Matrix<D, double>::diagonal(node.mass);
            node.residual = (node.aim - node.velocity) * node.mass;
        }
        block.clear_entries();
        for (auto& link : block.links()) {
            link.along = at(link.b).place - at(link.a).place;
            const double k = hardest * link.per_length2;
            const double rate = dot(link.along, at(link.b).velocity - at(link.a).velocity);
            const double pull = link.pull + k * rate;
            const bool resists = !link.one_sided() || (link.tension > 0 && pull > 0) || (link.tension < 0 && pull < 0);
            link.stiffness = resists && !block.soft(link) ? k : 0;
            if (link.stiffness == 0) continue;
            link.pull = pull;
            block.add(link, outer(link.along * k, link.along), link.along * pull);
        }
        block.bends().project_velocities(hardest);
        block.ways().project_velocities(hardest);
        hold(hardest);
        block.solve();
        for (auto& node : block.unknowns()) node.velocity += node.move;
        for (auto& link : block.links())
            if (link.stiffness > 0) link.pull += link.stiffness * dot(link.along, at(link.b).move - at(link.a).move);
        block.bends().end_round();
        block.ways().end_round();
    }
}

} // namespace sinew::detail

#pragma once

#include "sinew/solver/direct/equations.h"

namespace sinew::detail {

/// Impulse of an external term per speed that it lacks, kg.
template <int D> double velocity_stiffness(const BlockEquations<D>& block) {
    constexpr double relative = 1e3;
    return relative * block.total_mass();
}

/// Projects the velocities of a block onto the motions that the constraints allow (n . v = 0 for each active one), with
/// the least change of momentum: `rounds` solves of an augmented Lagrangian. One-sided limits take part only while
/// loaded. `hold(stiffness)` adds external terms, such as planes, to the equations.
template <int D, class Hold> void project_block_velocities(BlockEquations<D>& block, Hold&& hold, int rounds = 3) {
    const double hardest = velocity_stiffness(block);
    block.links().begin_settling();
    block.bends().begin_settling();
    block.ways().begin_settling();
    for (auto& node : block.nodes()) node.predicted = node.velocity;
    for (int i = 0; i < rounds; ++i) {
        for (auto& node : block.unknowns()) {
            node.diagonal = Matrix<D, double>::diagonal(node.mass);
            node.residual = (node.predicted - node.velocity) * node.mass;
        }
        block.clear_entries();
        block.links().project_velocities(hardest);
        block.bends().project_velocities(hardest);
        block.ways().project_velocities(hardest);
        hold(hardest);
        block.solve();
        for (auto& node : block.unknowns()) node.velocity += node.displacement;
        block.links().end_round();
        block.bends().end_round();
        block.ways().end_round();
    }
}

} // namespace sinew::detail

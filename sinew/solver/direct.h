#pragma once

#include "sinew/math/matrix.h"
#include "sinew/solver/id.h"

#include <cstdint>
#include <vector>

/// Acyclic figures, solved at once. Ropes, chains and trees of distances have no loops: a Newton step on all their
/// multipliers costs as much as a sweep or two, and unlike a sweep it is a solution. What cannot move (a pin, a wall)
/// does not close a loop.
namespace sinew {

/// Distances that hang together without a loop, as a rooted tree. Its edges stand in the order of elimination, a
/// particle's edges to its children before the one to its parent; the child of its edge k is its node k, and the root
/// is the last of count + 1 nodes.
struct Tree {
    std::uint32_t first_edge = 0, count = 0, first_node = 0;
};

struct TreeEdge {
    Row constraint = 0;
    Row child = 0, parent = 0;     ///< rows of Particles
    std::uint32_t parent_node = 0; ///< of the forest
};

/// The trees of a world, worked out once for a topology, and room for their solves: in double whatever the world's
/// precision, for a heavy weight on light links has no digits to spare.
template <int D> struct Forest {
    std::vector<TreeEdge> edges;
    std::vector<Tree> trees;
    std::vector<char> solved; ///< per distance of the world: done here, so the sweep leaves it out

    // Per node: the solve's unknowns and what they are found with. An edge's are those of its child.
    std::vector<Vec<D, double>> place, velocity, predicted, bias, moved, normal, along;
    std::vector<Matrix<D, double>> stiffness, coupling;
    std::vector<double> mobility, low, high, compliance, multiplier, warm, wanted, pivot;

    // Room for finding the trees.
    std::vector<Row> component, first_edge, edge_at, queue;
    std::vector<char> cyclic, visited;

    bool stale = true; ///< the topology, or who can move, has changed: the next step looks again

    /// Room for that many nodes.
    void resize(std::size_t nodes) {
        for (auto* column : {&place, &velocity, &predicted, &bias, &moved, &normal, &along}) column->resize(nodes);
        for (auto* column : {&stiffness, &coupling}) column->resize(nodes);
        for (auto* column : {&mobility, &low, &high, &compliance, &multiplier, &warm, &wanted, &pivot})
            column->resize(nodes);
    }
};

} // namespace sinew

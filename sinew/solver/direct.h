#pragma once

#include "sinew/math/matrix.h"
#include "sinew/solver/columns.h"
#include "sinew/solver/id.h"

#include <cstdint>
#include <span>
#include <vector>

/// Acyclic figures solved at once. Ropes, chains and trees of distances have no loops: a Newton step on all their
/// multipliers costs as much as one sweep, and unlike a sweep it is a solution. What cannot move (a pin, a wall) does
/// not close a loop.
namespace sinew {

/// Distances between particles that hang together without a loop, as a rooted tree. Edges stand in the order of
/// elimination: a particle's edges to its children before the one to its parent.
struct TreeEdge {
    Row constraint = 0;
    Row child = 0, parent = 0; ///< rows of Particles
    std::uint32_t parent_node =
        0; ///< nodes of a tree: the child of its edge k is node first_node + k, the root is the last
};

struct Tree {
    std::uint32_t first = 0, count = 0; ///< edges
    std::uint32_t first_node = 0;       ///< of count + 1
};

/// What is worked out once for a topology, and room for the solve.
template <int D, class Real> struct Forest {
    std::vector<TreeEdge> edges;
    std::vector<Tree> trees;
    std::vector<char> in_tree; ///< per distance: solved here, not in the sweep

    // Room for one solve, per node (K, bias, move) and per edge (the rest).
    std::vector<Matrix<D, Real>> stiffness;
    std::vector<Vec<D, Real>> bias, moved, normal, along;
    std::vector<Real> pivot, wanted, side;

    // Room for finding the trees.
    std::vector<Row> component, first_edge, edge_at, queue;
    std::vector<char> cyclic, visited;

    bool stale = true; ///< the topology, or who can move, has changed: the next step looks again
};

} // namespace sinew

#pragma once

#include "sinew/solver/simd/lane_pack.h"

/// Chains side by side in the lanes of packs: ropes held at the first node, of rigid links one after the other.
namespace sinew {

/// A node of a chain, and the link to the node before. V is a pack, with one number for each chain.
template <int D, class V> struct ChainNode {
    V start[D];    ///< position at the start of the substep, m
    V velocity[D]; ///< at the start of the substep, drag included, m/s
    V mass;        ///< kg
    V length2;     ///< squared length of the link, m^2
    V per_length2; ///< 1 / length2
    V pulls_only;  ///< 1: the link can go slack
    V tension;     ///< multiplier of (length^2 - limit^2) / 2 at the start of the substep, N/m

    // Work space of a substep.
    V position[D], predicted[D]; ///< position in this iteration, and without links, m
    V begun[D], span[D];         ///< link at the start of the substep, and in this iteration, m
    V after[D];                  ///< velocity at the end of the substep, m/s
    V pull, next;                ///< multiplier in this iteration and the next, kg
    V holds;                     ///< 1: the link is active; 0: slack
    V flips;                     ///< number of times the link has become active in this substep
    V displacement[D];           ///< Newton step, m
    V carried[D * D];            ///< move of this node per move of the node before
    V lever[D];                  ///< move of this node per multiplier of the link, negated
    V across[D];                 ///< row of the link after the elimination of this node
    V error, stiffness;          ///< right-hand side of that row, and its inverse pivot
};

/// A substep of several chains of the same number of links. The first node is immovable.
template <int D> struct ChainPack : LanePack<D> {
    int links = 0;
    double* nodes = nullptr; ///< links + 1 nodes, ChainNode<D, pack of `width`>
};

} // namespace sinew

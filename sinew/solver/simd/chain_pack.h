#pragma once

/// Chains side by side in the lanes of packs: ropes held at the first node, of rigid links one after the other.
namespace sinew {

/// Most chains side by side.
inline constexpr int max_chain_lanes = 8;

/// A node of a chain, and the link to the node before. V is a pack, with one number for each chain.
template <int D, class V> struct ChainNode {
    V start[D];    ///< position at the start of the substep, m
    V velocity[D]; ///< at the start of the substep, drag included, m/s
    V mass;        ///< kg
    V length2;     ///< squared length of the link, m^2
    V per_length2; ///< 1 / length2
    V tension;     ///< multiplier of (length^2 - limit^2) / 2 at the start of the substep, N/m

    // Work space of a substep.
    V place[D], aim[D];  ///< position in this iteration, and without links, m
    V begun[D], span[D]; ///< link at the start of the substep, and in this iteration, m
    V after[D];          ///< velocity at the end of the substep, m/s
    V pull, next;        ///< multiplier in this iteration and the next, kg
    V move[D];           ///< Newton step, m
    V carried[D * D];    ///< move of this node per move of the node before
    V lever[D];          ///< move of this node per multiplier of the link, negated
    V across[D];         ///< row of the link after the elimination of this node
    V error, stiffness;  ///< right-hand side of that row, and its inverse pivot
};

/// A substep of several chains of the same number of links. Numbers by lane; unused lanes have `active` 0.
template <int D> struct ChainPack {
    template <class T> struct alignas(64) Lanes {
        T lane[max_chain_lanes] = {};
    };
    int links = 0;
    int width = 1;           ///< lanes of the kernel
    double* nodes = nullptr; ///< links + 1 nodes, ChainNode<D, pack of `width`>; the first one is immovable
    double longest = 0;      ///< length of an undivided substep, s

    Lanes<double> active;       ///< 1 or 0
    Lanes<double> fresh;        ///< 1: lengths and velocities at the start are to be examined
    Lanes<double> pulls_only;   ///< 1: the links can go slack
    Lanes<double> shortest;     ///< 1: the substep is not to be divided any further
    Lanes<double> h;            ///< length of the substep, s
    Lanes<double> keep, yield;  ///< factors of drag (math/decay.h)
    Lanes<double> push[D];      ///< acceleration times `yield`, m/s^2
    Lanes<double> reach;        ///< total length, m
    Lanes<double> weight_reach; ///< weight times total length, J

    Lanes<double> low[D], high[D]; ///< room in which the nodes meet nothing, m

    /// Results.
    Lanes<double> good;  ///< 1: the chain has moved on by h; otherwise it is as before
    Lanes<double> alien; ///< 1: a substep that needs more than shorter substeps: slack, stretched, or struck
    Lanes<double> lost;  ///< energy lost, times `yield`, J
};

} // namespace sinew

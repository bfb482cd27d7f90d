#pragma once

#include "sinew/solver/simd/chain_pack.h"
#include "sinew/table/id.h"

#include <algorithm>
#include <cstdint>
#include <vector>

/// Chains: blocks that are a rope of plain links, held at one end. Many are solved side by side (direct/step_chains.h).
namespace sinew {

/// A link of a chain and the particle at its far end.
struct ChainLink {
    Row particle = 0, constraint = 0;
    std::uint32_t node = 0, link = 0; ///< in `Blocks`
    double length = 0;                ///< m
    bool pulls_only = false;          ///< can go slack
};

struct BlockChain {
    std::uint32_t first = 0, links = 0; ///< range in Chains::links, from the held end on
    std::uint32_t held_node = 0;        ///< the immovable node, in `Blocks`
    Row held = 0;
};

/// A block that is a chain, in the order in which chains are solved.
struct ChainTurn {
    std::uint32_t links = 0, block = 0;
};

/// Work space of a thread.
template <int D> struct ChainSpace {
    /// Longer chains are solved one by one: in lanes they would not stay in the cache.
    static constexpr std::uint32_t max_links_in_lanes = 256;

    ChainPack<D> pack;
    std::vector<double> numbers;     ///< of the nodes of a pack
    std::vector<std::uint32_t> rows; ///< particles of the nodes of a pack

    void make_room(std::size_t links) {
        constexpr std::size_t line = 64 / sizeof(double), per_node = sizeof(ChainNode<D, double>) / sizeof(double);
        const auto in_lanes = std::min<std::size_t>(links, max_links_in_lanes) + 1;
        const auto needed =
            std::max((links + 1) * per_node * min_block_lanes, in_lanes * per_node * max_block_lanes) + line;
        if (numbers.size() < needed) numbers.resize(needed), rows.resize(needed / per_node);
        const auto at = reinterpret_cast<std::uintptr_t>(numbers.data()) / sizeof(double);
        pack.nodes = numbers.data() + (line - at % line) % line;
    }
};

template <int D> struct Chains {
    std::vector<BlockChain> list;
    std::vector<ChainLink> links;
    std::vector<ChainTurn> turns; ///< by number of links, then in the order of the blocks
    std::vector<ChainSpace<D>> spaces;
    std::vector<std::uint32_t> ends; ///< scratch: up to two links of each node of a block

    /// Reserves for every state that so many particles and distances can reach by tearing.
    void reserve(std::size_t particles, std::size_t distances) {
        list.reserve(2 * distances + 4 * particles);
        links.reserve(2 * distances + 4 * particles);
        turns.reserve(particles / 2 + 1);
        ends.reserve(2 * (particles + distances) + 2);
    }
};

} // namespace sinew

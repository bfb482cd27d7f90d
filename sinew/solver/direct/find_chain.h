#pragma once

#include "sinew/math/sort.h"
#include "sinew/solver/block.h"
#include "sinew/solver/workers.h"

#include <algorithm>

/// Blocks that are chains: rigid links one after the other, held at the first node by an immovable particle.
namespace sinew::detail {

template <int D> class ChainFinder {
  public:
    ChainFinder(Blocks<D>& blocks, Block& block) : blocks_(blocks), chains_(blocks.chains), block_(block) {}

    /// Appends the block to the chains, if it is one.
    void run() {
        block_.chain = Blocks<D>::none;
        if (!is_plain()) return;
        list_ends();
        const auto first = std::uint32_t(chains_.links.size());
        if (!walk()) return chains_.links.resize(first);
        const auto held = block_.first_node + block_.unknowns;
        block_.chain = std::uint32_t(chains_.list.size());
        chains_.list.push_back(
            {.first = first, .links = block_.links, .held_node = held, .held = blocks_.nodes[held].row});
    }

  private:
    Blocks<D>& blocks_;
    Chains<D>& chains_;
    Block& block_;

    bool is_plain() {
        if (block_.bends > 0 || block_.ways > 0 || block_.springy || block_.is_motorized || block_.load_tethers > 0)
            return false;
        if (block_.nodes != block_.unknowns + 1 || block_.links != block_.unknowns) return false;
        for (auto i = block_.first_link; i < block_.first_link + block_.links; ++i) {
            const auto& link = blocks_.links[i];
            if ((link.low < link.high && link.low > 0) || link.length != link.high) return false;
        }
        return true;
    }

    std::uint32_t& end(std::uint32_t node, std::uint32_t which) {
        return chains_.ends[2 * (node - block_.first_node) + which];
    }
    void list_ends() {
        chains_.ends.assign(2 * block_.nodes, Blocks<D>::none);
        for (auto i = block_.first_link; i < block_.first_link + block_.links; ++i)
            for (const auto node : {blocks_.links[i].a, blocks_.links[i].b})
                end(node, end(node, 0) == Blocks<D>::none ? 0 : 1) = i;
    }

    /// Lists the links from the immovable node on. False if they are not all on one way.
    bool walk() {
        auto node = block_.first_node + block_.unknowns;
        auto before = Blocks<D>::none;
        for (std::uint32_t k = 0; k < block_.links; ++k) {
            const auto next = end(node, 0) == before ? end(node, 1) : end(node, 0);
            if (next == Blocks<D>::none) return false;
            const auto& link = blocks_.links[next];
            node = link.a == node ? link.b : link.a;
            before = next;
            chains_.links.push_back({.particle = blocks_.nodes[node].row,
                                     .constraint = link.constraint,
                                     .node = node,
                                     .link = next,
                                     .length = link.length,
                                     .pulls_only = link.low < link.high});
        }
        return true;
    }
};

/// Number of parts into which the work in lanes is divided. More than threads, because blocks that whip take longer.
inline int parts_in_lanes(int threads) {
    constexpr int per_thread = 4;
    const int all = threads > 0 ? threads : hardware_threads();
    return all > 1 ? per_thread * all : 1;
}

/// Lists the chains by number of links, and makes room to solve them in so many parts at the same time.
template <int D> void order_chains(Blocks<D>& blocks, std::size_t parts) {
    auto& turns = blocks.chains.turns;
    turns.clear();
    std::size_t longest = 0;
    for (std::uint32_t i = 0; i < blocks.list.size(); ++i) {
        if (blocks.list[i].chain == Blocks<D>::none) continue;
        turns.push_back({blocks.list[i].links, i});
        longest = std::max<std::size_t>(longest, blocks.list[i].links);
    }
    sinew::sort(turns.begin(), turns.end(), [](const ChainTurn& a, const ChainTurn& b) {
        return a.links != b.links ? a.links < b.links : a.block < b.block;
    });
    auto& spaces = blocks.chains.spaces;
    if (turns.empty()) return;
    if (spaces.size() < parts) spaces.resize(parts);
    for (auto& space : spaces) space.make_room(longest);
}

} // namespace sinew::detail

#pragma once

#include "sinew/assert/assert.h"
#include "sinew/math/sort.h"
#include "sinew/solver/block.h"

#include <algorithm>

namespace sinew::detail {

/// Matrix entry by which a node is coupled with a later one.
template <int D> std::uint32_t entry_of(const Blocks<D>& blocks, std::uint32_t column, std::uint32_t node) {
    auto entry = blocks.first_entry[column];
    while (blocks.entries[entry].node != node) ++entry;
    SINEW_ASSERT(column + 1 >= blocks.first_entry.size() || entry < blocks.first_entry[column + 1],
                 "two nodes of a constraint are coupled");
    return entry;
}

/// Adds the entries of a block's matrix, those filled by the elimination included, and for each two entries of a node
/// the entry that receives the product.
template <int D> void add_entries(Blocks<D>& blocks, const Elimination& elimination, const Block& block) {
    for (std::uint32_t i = 0; i < block.unknowns; ++i) {
        blocks.first_entry.push_back(std::uint32_t(blocks.entries.size()));
        const auto begin = std::ptrdiff_t(blocks.entries.size());
        for (const Row neighbour : elimination.neighbours(elimination.order()[i]))
            blocks.entries.push_back({.node = block.first_node + elimination.position(neighbour)});
        sinew::sort(blocks.entries.begin() + begin, blocks.entries.end(),
                    [](const auto& a, const auto& b) { return a.node < b.node; });
    }
    blocks.first_entry.push_back(std::uint32_t(blocks.entries.size()));
    for (std::uint32_t i = block.first_node; i < block.first_node + block.unknowns; ++i) {
        blocks.first_pair.push_back(std::uint32_t(blocks.pairs.size()));
        for (auto e = blocks.first_entry[i]; e < blocks.first_entry[i + 1]; ++e)
            for (auto g = e + 1; g < blocks.first_entry[i + 1]; ++g)
                blocks.pairs.push_back(entry_of(blocks, blocks.entries[e].node, blocks.entries[g].node));
    }
    blocks.first_entry.pop_back();
}

} // namespace sinew::detail

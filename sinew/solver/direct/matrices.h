#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/block.h"

namespace sinew::detail {

template <int D> void substitute_back(Blocks<D>& blocks, const Block& block) {
    auto* const nodes = blocks.nodes.data();
    for (auto i = block.first_node + block.unknowns; i-- > block.first_node;) {
        Vec<D, double> pulled{};
        for (auto e = blocks.first_entry[i]; e < blocks.first_entry[i + 1]; ++e)
            pulled += blocks.entries[e].upper * nodes[blocks.entries[e].node].displacement;
        nodes[i].displacement -= nodes[i].diagonal * pulled;
    }
}

/// Solves a block's equations for `displacement`, in the elimination order (elimination.h): LU by D x D blocks, of
/// equal structure but different values on both sides of the diagonal. With D_i the diagonal of node i, L_e and U_e the
/// entries below and to the right,
///
///     y_i = D_i^-1 r_i       r_j -= L_e y_i       D_j -= L_e D_i^-1 U_e
///     A_ge -= L_g D_i^-1 U_e       A_eg -= L_e D_i^-1 U_g
///     displacement_i = y_i - D_i^-1 sum U_e displacement_j
template <int D> void solve_block(Blocks<D>& blocks, const Block& block) {
    auto* const nodes = blocks.nodes.data();
    auto* const entries = blocks.entries.data();
    const auto* const first_entry = blocks.first_entry.data();
    const auto begin = block.first_node, end = begin + block.unknowns;
    for (auto i = begin; i < end; ++i) {
        auto& node = nodes[i];
        const auto per = node.diagonal = inverse(node.diagonal);
        const auto y = node.displacement = per * node.residual;
        auto pair = blocks.first_pair[i];
        for (auto e = first_entry[i]; e < first_entry[i + 1]; ++e) {
            const auto& entry = entries[e];
            const auto right = per * entry.upper, down = entry.lower * per;
            SINEW_ASSERT(entry.node > i && entry.node < end, "an entry couples with a node eliminated later");
            auto& other = nodes[entry.node];
            other.diagonal -= entry.lower * right;
            other.residual -= entry.lower * y;
            for (auto g = e + 1; g < first_entry[i + 1]; ++g) {
                SINEW_ASSERT(blocks.pairs[pair] < blocks.entries.size(),
                             "elimination fills entries of the matrix only");
                auto& filled = entries[blocks.pairs[pair++]];
                filled.lower -= entries[g].lower * right;
                filled.upper -= down * entries[g].upper;
            }
        }
    }
    substitute_back(blocks, block);
}

/// Solves for another right-hand side, with the factors of solve_block.
template <int D> void solve_block_again(Blocks<D>& blocks, const Block& block) {
    auto* const nodes = blocks.nodes.data();
    for (auto i = block.first_node; i < block.first_node + block.unknowns; ++i) {
        auto& node = nodes[i];
        node.displacement = node.diagonal * node.residual;
        for (auto e = blocks.first_entry[i]; e < blocks.first_entry[i + 1]; ++e)
            nodes[blocks.entries[e].node].residual -= blocks.entries[e].lower * node.displacement;
    }
    substitute_back(blocks, block);
}

} // namespace sinew::detail

#pragma once

#include "sinew/solver/block.h"

namespace sinew::detail {

/// Solves a block's equations for `move`, in the order that fill was worked out for (elimination.h): LU by D x D parts,
/// alike in structure but not in value on both sides of the diagonal. With D_i the diagonal of node i, L_e and U_e what
/// it has below and to the right,
///
///     y_i = D_i^-1 r_i       r_j -= L_e y_i       D_j -= L_e D_i^-1 U_e       A_ge -= L_g D_i^-1 U_e       A_eg -= L_e
///     D_i^-1 U_g move_i = y_i - D_i^-1 sum U_e move_j
template <int D> void solve_block(Blocks<D>& blocks, const Block& block) {
    auto* const nodes = blocks.nodes.data();
    auto* const entries = blocks.entries.data();
    const auto* const first_entry = blocks.first_entry.data();
    const auto begin = block.first_node, end = begin + block.unknowns;
    for (auto i = begin; i < end; ++i) {
        auto& node = nodes[i];
        const auto per = node.diagonal = inverse(node.diagonal);
        const auto y = node.move = per * node.residual;
        auto pair = blocks.first_pair[i];
        for (auto e = first_entry[i]; e < first_entry[i + 1]; ++e) {
            const auto& entry = entries[e];
            const auto right = per * entry.upper, down = entry.lower * per;
            auto& other = nodes[entry.node];
            other.diagonal -= entry.lower * right;
            other.residual -= entry.lower * y;
            for (auto g = e + 1; g < first_entry[i + 1]; ++g) {
                auto& filled = entries[blocks.pairs[pair++]];
                filled.lower -= entries[g].lower * right;
                filled.upper -= down * entries[g].upper;
            }
        }
    }
    for (auto i = end; i-- > begin;) {
        auto& node = nodes[i];
        Vec<D, double> pulled{};
        for (auto e = first_entry[i]; e < first_entry[i + 1]; ++e)
            pulled += entries[e].upper * nodes[entries[e].node].move;
        node.move -= node.diagonal * pulled;
    }
}

} // namespace sinew::detail

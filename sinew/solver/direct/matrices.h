#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/block.h"

namespace sinew::detail {

/// Inverse of a node's diagonal, or the zero matrix where it is singular. A light node on rigid links has a tiny
/// inertia across them: the determinant of a 3 x 3 matrix would lose that to rounding twice over. The largest pivot is
/// eliminated first, and the determinant is that of the 2 x 2 matrix left.
inline Matrix<2, double> pivot_inverse(const Matrix<2, double>& m) {
    return inverse(m);
}
inline Matrix<3, double> pivot_inverse(const Matrix<3, double>& m) {
    const auto at = [&](std::size_t row, std::size_t column) { return m.column[column][int(row)]; };
    std::size_t p = 0;
    for (std::size_t i = 1; i < 3; ++i)
        if (absolute(at(i, i)) > absolute(at(p, p))) p = i;
    if (at(p, p) == 0) return {};
    const std::size_t rest[] = {(p + 1) % 3, (p + 2) % 3};
    const double per = 1 / at(p, p);
    Vec<2, double> down, right;
    for (std::size_t i = 0; i < 2; ++i) down[int(i)] = at(rest[i], p) * per, right[int(i)] = at(p, rest[i]) * per;
    Matrix<2, double> left;
    for (std::size_t k = 0; k < 2; ++k)
        for (std::size_t i = 0; i < 2; ++i)
            left.column[k][int(i)] = at(rest[i], rest[k]) - down[int(i)] * at(p, rest[k]);
    const auto inner = inverse(left);
    Matrix<3, double> result;
    const auto set = [&](std::size_t row, std::size_t column, double value) {
        result.column[column][int(row)] = value;
    };
    const auto across = inner * down;
    double corner = per;
    for (std::size_t k = 0; k < 2; ++k) {
        set(rest[k], p, -across[int(k)]);
        set(p, rest[k], -dot(right, inner.column[k]));
        corner += right[int(k)] * across[int(k)];
        for (std::size_t i = 0; i < 2; ++i) set(rest[i], rest[k], inner.column[k][int(i)]);
    }
    set(p, p, corner);
    return result;
}

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
        const auto per = node.diagonal = pivot_inverse(node.diagonal);
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

#pragma once

#include "sinew/solver/block.h"

namespace sinew::detail {

/// Gauss-Seidel sweeps over the links from the start positions: brings lengths nearer where Newton's method fails.
template <int D> void relax_links(Blocks<D>& blocks, const Block& block) {
    constexpr int rounds = 20;
    const auto nodes = std::span(blocks.nodes), unknowns = nodes.subspan(block.first_node, block.unknowns);
    const auto mobility = [&](std::uint32_t i) {
        return i < block.first_node + block.unknowns ? inverse_or_zero(nodes[i].mass) : 0;
    };
    for (auto& node : unknowns) node.position = node.start;
    for (int i = 0; i < rounds; ++i)
        for (const auto& link : std::span(blocks.links).subspan(block.first_link, block.links)) {
            auto &a = nodes[link.a], &b = nodes[link.b];
            const double wa = mobility(link.a), wb = mobility(link.b);
            const auto now = b.position - a.position;
            const double length = norm(now);
            const auto correction = now * ((length - clamp(length, link.low, link.high)) * inverse_or_zero(length) *
                                           inverse_or_zero(wa + wb));
            a.position += correction * wa;
            b.position -= correction * wb;
        }
}

} // namespace sinew::detail

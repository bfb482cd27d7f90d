#pragma once

#include "sinew/solver/block.h"
#include "sinew/solver/plan.h"
#include "sinew/world/constraint_graph.h"

namespace sinew::detail {

/// True for a particle on which constraints outside the blocks act.
template <int D, class Real> bool is_port(const World<D, Real>& world, const Blocks<D>& blocks, Row row) {
    bool found = false;
    for_each_constraint(world, row,
                        [&](const auto& table, Row constraint) { found = found || !blocks.holds(table, constraint); });
    return found;
}

/// Adds a link from a node to a fixed node apart, without a limit for the time being.
template <int D> void add_load_tether(Blocks<D>& blocks, std::uint32_t node) {
    constexpr double far = 1e12;
    DistanceRow<D> tether;
    tether.slot = no_row;
    tether.high = far;
    tether.a = node;
    tether.b = std::uint32_t(blocks.nodes.size());
    tether.entry = Blocks<D>::none;
    const auto& at = blocks.nodes[node];
    blocks.nodes.push_back({.row = at.row, .slot = at.slot});
    blocks.links.push_back(tether);
}

/// Adds the ports of a block: nodes on which constraints outside the block act. Each gets load tethers, inactive at
/// first (ports/load_tethers.h). Load tethers are the last links of the block, hence added after everything else.
template <int D, class Real> void add_ports(const World<D, Real>& world, Blocks<D>& blocks, Block& block) {
    for (std::uint32_t i = block.first_node; i < block.first_node + block.unknowns; ++i) {
        if (!is_port(world, blocks, blocks.nodes[i].row)) continue;
        ++block.ports;
        for (std::size_t t = 0; t < max_tethers; ++t) add_load_tether(blocks, i);
        block.load_tethers += std::uint32_t(max_tethers);
    }
    block.links += block.load_tethers;
}

} // namespace sinew::detail

#pragma once

#include "sinew/solver/world.h"

namespace sinew::detail {

/// Looks up the rows of a block by slots, if rows have moved since the last look-up.
template <int D, class Real> void look_up_rows(World<D, Real>& world, Block& block) {
    auto& blocks = world.blocks;
    if (block.row_moves == blocks.row_moves) return;
    block.row_moves = blocks.row_moves;
    const auto each = [](auto& column, std::uint32_t first, std::uint32_t count, auto&& visit) {
        for (auto i = first; i < first + count; ++i) visit(column[i]);
    };
    const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    const auto& angles = std::get<kind_number<Angle, D>>(world.constraints);
    const auto& pulleys = std::get<kind_number<Pulley, D>>(world.constraints);
    const auto row_in = [](const auto& table) {
        return [&table](BlockLimit& limit) {
            if (limit.slot != no_row) limit.constraint = table.slots.row_at(limit.slot); // none in a load tether
        };
    };
    each(blocks.nodes, block.first_node, block.nodes,
         [&](BlockNode<D>& node) { node.row = world.particles.slots.row_at(node.slot); });
    each(blocks.links, block.first_link, block.links, row_in(distances));
    each(blocks.bends, block.first_bend, block.bends, [&](AngleRow<D>& bend) {
        if constexpr (D == 3)
            if (bend.is_fold()) return row_in(std::get<kind_number<Volume, D>>(world.constraints))(bend);
        row_in(angles)(bend);
    });
    each(blocks.ways, block.first_way, block.ways, [&](CableRow& way) {
        way.constraint = way.is_pulley ? pulleys.slots.row_at(way.slot) : distances.slots.row_at(way.slot);
    });
}

} // namespace sinew::detail

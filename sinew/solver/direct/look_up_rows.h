#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/block.h"
#include "sinew/world/world.h"

namespace sinew::detail {

/// Looks up the rows of a block by slots, if rows have moved since the last look-up.
template <int D, class Real> void look_up_rows(const World<D, Real>& world, Blocks<D>& blocks, Block& block) {
    if (block.row_moves == world.journal.row_moves) return;
    block.row_moves = world.journal.row_moves;
    const auto each = [](auto& column, std::uint32_t first, std::uint32_t count, auto&& visit) {
        for (auto i = first; i < first + count; ++i) visit(column[i]);
    };
    const auto& distances = std::get<kind_number<Distance, D>>(world.constraints);
    const auto& angles = std::get<kind_number<Angle, D>>(world.constraints);
    const auto& pulleys = std::get<kind_number<Pulley, D>>(world.constraints);
    const auto row_in = [](const auto& table) {
        return [&table](BlockLimit& limit) {
            if (limit.slot == no_row) return; // a load tether
            SINEW_ASSERT(table.handles.in_use(limit.slot), "a block ends when a constraint of it is removed");
            limit.constraint = table.handles.row_at(limit.slot);
        };
    };
    each(blocks.nodes, block.first_node, block.nodes, [&](BlockNode<D>& node) {
        SINEW_ASSERT(world.particles.handles.in_use(node.slot), "a block ends when a particle of it is removed");
        node.row = world.particles.handles.row_at(node.slot);
    });
    each(blocks.links, block.first_link, block.links, row_in(distances));
    each(blocks.bends, block.first_bend, block.bends, [&](AngleRow<D>& bend) {
        if (bend.replaces_link) return row_in(distances)(bend);
        if constexpr (D == 3)
            if (bend.is_fold()) return row_in(std::get<kind_number<Volume, D>>(world.constraints))(bend);
        row_in(angles)(bend);
    });
    each(blocks.ways, block.first_way, block.ways, [&](CableRow& way) {
        way.constraint = way.is_pulley ? pulleys.handles.row_at(way.slot) : distances.handles.row_at(way.slot);
    });
}

} // namespace sinew::detail

#pragma once

#include "sinew/solver/block.h"

#include <algorithm>

/// Properties of a block's rows that decide how the block is solved.
namespace sinew::detail {

/// True if the test holds for any of a range of rows.
template <class Rows, class Test>
bool any_row(const Rows& rows, std::uint32_t first, std::uint32_t count, Test&& test) {
    return std::any_of(rows.begin() + first, rows.begin() + first + count, test);
}

/// True if some limits are driven, and may do work.
template <int D> bool is_motorized(const Blocks<D>& blocks, const Block& block) {
    constexpr auto is_driven = [](const BlockDrive& drive) { return drive.motorized; };
    return any_row(blocks.ways, block.first_way, block.ways, is_driven) ||
           any_row(blocks.bends, block.first_bend, block.bends, is_driven);
}

/// Number of links that are a joint's range.
template <int D> std::uint32_t ranges_of(const Blocks<D>& blocks, const Block& block) {
    const auto first = blocks.links.begin() + block.first_link;
    return std::uint32_t(
        std::count_if(first, first + block.links, [](const DistanceRow<D>& link) { return link.is_range(); }));
}

/// True if some constraints are compliant.
template <int D> bool is_springy(const Blocks<D>& blocks, const Block& block) {
    constexpr auto is_compliant = [](const BlockLimit& limit) { return limit.is_compliant(); };
    return any_row(blocks.links, block.first_link, block.links, is_compliant) ||
           any_row(blocks.bends, block.first_bend, block.bends, is_compliant) ||
           any_row(blocks.ways, block.first_way, block.ways, is_compliant);
}

} // namespace sinew::detail

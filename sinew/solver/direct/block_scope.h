#pragma once

#include "sinew/solver/block.h"
#include "sinew/solver/direct/graph.h"

namespace sinew::detail {

/// Membership of constraints in the block being built.
template <int D, class Real> struct BlockScope {
    const BlockGraph<D, Real>& graph;
    BlockRoom& room;
    Row part = no_row;     ///< value of `BlockRoom::part_of` for the members
    bool attached = false; ///< the block hangs on the rest of the world, and takes rigid constraints only

    /// True if all movable members of a constraint are in this block.
    template <class Table> bool takes(const Table& table, Row row) const {
        for (const Row member : table.members[row])
            if (graph.mobile(member) && room.part_of[member] != part) return false;
        return !attached || graph.is_rigid(table, row);
    }
};

} // namespace sinew::detail

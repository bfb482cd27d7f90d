#pragma once

#include "sinew/math/union_find.h"
#include "sinew/solver/solver.h"
#include "sinew/table/row_lists.h"

namespace sinew {

/// Bodies of the internal damping: connected movable particles of one figure. A piece cut off is a body of its own.
struct DampedBodies {
    UnionFind sets;
    std::vector<Row> number_of;  ///< per row: the body
    RowLists<Row> rows;          ///< per body
    std::uint64_t edits = ~0ull; ///< of the world when the bodies were found
};

} // namespace sinew

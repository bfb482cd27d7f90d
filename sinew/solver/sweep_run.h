#pragma once

#include "sinew/table/id.h"

namespace sinew {

/// Rows [first, last) of a table.
struct Rows {
    Row first = 0, last = 0;
};

/// Consecutive constraints of one kind, in the order of the sweep.
struct SweepRun {
    int kind = 0;
    Rows rows;
    bool both_ways = false; ///< each iteration projects them there and back
};

} // namespace sinew

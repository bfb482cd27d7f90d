#pragma once

#include "sinew/solver/swept.h"

namespace sinew {

/// Calls visit(row, slot) for the particles in slots [first, last): in the order of their rows where these lie side by
/// side, for what is read one after the other is fetched ahead.
template <int D, class Real, class Visit>
void each_row(const Swept<D, Real>& swept, Row first, Row last, Visit&& visit) {
    if (first == last) return;
    const Row count = last - first, low = swept.row_of[first];
    bool side_by_side = swept.row_of[last - 1] - low == count - 1;
    for (Row row = low; side_by_side && row < low + count; ++row) side_by_side = swept.slot_of[row] - first < count;
    if (side_by_side)
        for (Row row = low; row < low + count; ++row) visit(row, swept.slot_of[row]);
    else
        for (Row slot = first; slot < last; ++slot) visit(swept.row_of[slot], slot);
}

} // namespace sinew

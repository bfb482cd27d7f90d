#pragma once

#include "sinew/assert/assert.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

/// A table is a struct of equally long columns, listed once in `columns(self, visit)`. Growing, erasing and hashing
/// rows walk the list, so a new column is one line.
namespace sinew {

/// Equality to the last bit: -0 differs from 0, and NaN from everything.
template <class T> bool are_same(T a, T b) {
    if constexpr (std::is_floating_point_v<T>)
        return a == b && std::signbit(a) == std::signbit(b);
    else
        return a == b;
}

/// First row from `from` on with the flag, 0 or 1; flags.size() if there is none.
inline std::size_t next_flag(std::span<const char> flags, std::size_t from, char flag) {
    if (from >= flags.size()) return flags.size();
    const void* found = std::memchr(flags.data() + from, flag, flags.size() - from);
    return found ? std::size_t(static_cast<const char*>(found) - flags.data()) : flags.size();
}

/// Removes the rows whose flag in `gone` is set; the others keep their order.
template <class T> void erase_rows(std::vector<T>& column, std::span<const char> gone) {
    SINEW_ASSERT(gone.size() == column.size(), "every row has a flag");
    const auto at = [&](std::size_t row) { return column.begin() + std::ptrdiff_t(row); };
    std::size_t end = next_flag(gone, 0, 1);
    auto kept = at(end);
    for (std::size_t first; (first = next_flag(gone, end, 0)) < gone.size();) {
        end = next_flag(gone, first, 1);
        kept = std::copy(at(first), at(end), kept);
    }
    column.erase(kept, column.end());
}

template <class Table> void erase_rows(Table& table, std::span<const char> gone) {
    Table::columns(table, [&](auto& column) { erase_rows(column, gone); });
}

template <class Table> void reserve_rows(Table& table, std::size_t rows) {
    Table::columns(table, [&](auto& column) { column.reserve(rows); });
}

} // namespace sinew

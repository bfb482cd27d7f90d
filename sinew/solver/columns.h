#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// A table is a struct of equally long columns that it lists once, in `columns(self, visit)`. Growing, erasing, hashing
/// and copying rows walk that list, so a new column is one line.
namespace sinew {

/// Removes the rows whose flag in `gone` is set; the others keep their order.
template <class T> void erase_rows(std::vector<T>& column, std::span<const char> gone) {
    std::size_t kept = 0;
    for (std::size_t row = 0; row < column.size(); ++row)
        if (!gone[row]) column[kept++] = column[row];
    column.resize(kept);
}

template <class Table> void erase_rows(Table& table, std::span<const char> gone) {
    Table::columns(table, [&](auto& column) { erase_rows(column, gone); });
}

template <class Table> void reserve_rows(Table& table, std::size_t rows) {
    Table::columns(table, [&](auto& column) { column.reserve(rows); });
}

} // namespace sinew

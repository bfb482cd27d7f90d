#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace sinew::cli {

/// True for a file that begins like a trace (`run --trace`), as a table or as lines of JSON.
bool is_trace_file(const std::string& path);

/// First number of two traces that differs, or the first row or column that one of them lacks.
struct TraceDifference {
    std::size_t line = 0;          ///< in the file, from 1
    std::string row{};             ///< "at 0.5 (bob/head)"; "the heading" of a column
    std::string field{};           ///< "x", or "position[0]"; "the row", which one of the traces lacks
    std::string first{}, second{}; ///< "missing" where there is none
    std::size_t rows = 0;          ///< number of rows that differ
    double most = 0;               ///< largest difference of a number
};

/// Compares traces line by line, as far as the shorter one goes; `rows` is the number of rows compared. Nothing where
/// both have the same rows and columns, and all are equal. Throws CommandError for a line that is no row, with its
/// place.
std::optional<TraceDifference> trace_difference(const std::string& first, const std::string& second, std::size_t& rows);

} // namespace sinew::cli

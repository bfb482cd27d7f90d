#include "apps/cli/diff_trace.h"

#include "apps/cli/console.h"
#include "apps/cli/session_file.h"
#include "apps/cli/stepping.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace sinew::cli {
namespace {

constexpr std::string_view openings[] = {"time,nam", "{\"time\":"}; // of a table, of an object: head_of() has 8 bytes

/// Cells of a line of a table; quotes around a cell are removed, and two in it are one.
std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            cells.back() += line[++i];
        else if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] == ',' && !quoted)
            cells.emplace_back();
        else
            cells.back() += line[i];
    }
    return cells;
}

/// Rows of a trace, one after the other: pairs of a field and its text.
class TraceReader {
  public:
    using Row = std::vector<std::pair<std::string, std::string>>;

    explicit TraceReader(std::string path) : path_(std::move(path)), file_(path_) {
        if (file_.peek() != '{' && next_line()) fields_ = cells_of(text_);
    }

    std::size_t line() const { return line_; }
    /// False at the end.
    bool read(Row& row) {
        row.clear();
        if (!next_line()) return false;
        fields_.empty() ? read_json(row) : read_table(row);
        return true;
    }

  private:
    std::string path_;
    std::ifstream file_;
    std::size_t line_ = 0;
    std::string text_;
    std::vector<std::string> fields_; ///< of a table

    bool next_line() {
        ++line_;
        return bool(std::getline(file_, text_));
    }
    void read_table(Row& row) const {
        auto cells = cells_of(text_);
        if (cells.size() != fields_.size())
            refuse(path_, fmt::format("line {}: {} cells, {} expected", line_, cells.size(), fields_.size()));
        for (std::size_t i = 0; i < cells.size(); ++i) row.emplace_back(fields_[i], std::move(cells[i]));
    }
    void read_json(Row& row) const {
        const auto object = nlohmann::json::parse(text_, nullptr, false);
        if (!object.is_object()) refuse(path_, fmt::format("line {}: no object of a trace", line_));
        for (const auto& [name, value] : object.items()) {
            if (!value.is_array()) row.emplace_back(name, value.is_string() ? value.get<std::string>() : value.dump());
            for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
                row.emplace_back(fmt::format("{}[{}]", name, i), value[i].dump());
        }
    }
};

std::string text_at(const TraceReader::Row& row, std::string_view field) {
    const auto found = std::ranges::find(row, field, [](const auto& cell) { return cell.first; });
    return found == row.end() ? std::string() : found->second;
}

double apart(const std::string& a, const std::string& b) {
    return std::fabs(std::strtod(a.c_str(), nullptr) - std::strtod(b.c_str(), nullptr));
}

/// Largest difference of two rows, and the first cell that differs; null where they are equal.
const TraceReader::Row::value_type* first_difference(const TraceReader::Row& a, const TraceReader::Row& b,
                                                     double& most) {
    const TraceReader::Row::value_type* found = nullptr;
    for (const auto& cell : a) {
        const auto other = text_at(b, cell.first);
        if (cell.second == other) continue;
        if (!found) found = &cell;
        most = std::max(most, apart(cell.second, other));
    }
    return found;
}

} // namespace

bool is_trace_file(const std::string& path) {
    const auto head = head_of(path);
    const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
    return std::ranges::find(openings, text) != std::end(openings);
}

std::optional<TraceDifference> trace_difference(const std::string& first, const std::string& second,
                                                std::size_t& rows) {
    if (head_of(first) != head_of(second)) refuse(second, "a trace of another kind than " + first);
    TraceReader a(first), b(second);
    TraceReader::Row left, right;
    std::optional<TraceDifference> found;
    double most = 0;
    for (rows = 0; a.read(left) && b.read(right); ++rows) {
        give_up_if_interrupted();
        const auto* cell = first_difference(left, right, most);
        if (!cell) continue;
        if (!found)
            found = TraceDifference{.line = a.line(),
                                    .row = fmt::format("at {} ({})", text_at(left, "time"), text_at(left, "name")),
                                    .field = cell->first,
                                    .first = cell->second,
                                    .second = text_at(right, cell->first)};
        ++found->rows;
    }
    if (found) found->most = most;
    return found;
}

} // namespace sinew::cli

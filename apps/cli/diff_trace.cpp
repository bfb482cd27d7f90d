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
    /// Columns of a table, each called by its text; empty for lines of JSON.
    Row heading() const {
        Row row;
        for (const auto& field : fields_) row.emplace_back(field, field);
        return row;
    }
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

using Cell = TraceReader::Row::value_type;

/// Null for a field that the row has not.
const std::string* cell_at(const TraceReader::Row& row, std::string_view field) {
    const auto found = std::ranges::find(row, field, &Cell::first);
    return found == row.end() ? nullptr : &found->second;
}

std::string text_at(const TraceReader::Row& row, std::string_view field) {
    const auto* cell = cell_at(row, field);
    return cell ? *cell : "missing";
}

double apart(const std::string& a, const std::string& b) {
    return std::fabs(std::strtod(a.c_str(), nullptr) - std::strtod(b.c_str(), nullptr));
}

/// Largest difference of two rows, and the first cell that differs or is missing in one; null where they are equal.
const Cell* first_difference(const TraceReader::Row& a, const TraceReader::Row& b, double& most) {
    const Cell* found = nullptr;
    for (const auto& cell : a) {
        const auto* other = cell_at(b, cell.first);
        if (other && cell.second == *other) continue;
        if (!found) found = &cell;
        if (other) most = std::max(most, apart(cell.second, *other));
    }
    if (found || a.size() == b.size()) return found;
    const auto extra = std::ranges::find_if(b, [&](const Cell& cell) { return !cell_at(a, cell.first); });
    return extra == b.end() ? nullptr : &*extra;
}

std::string called(const TraceReader::Row& row) {
    return fmt::format("at {} ({})", text_at(row, "time"), text_at(row, "name"));
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
    auto left = a.heading(), right = b.heading();
    std::optional<TraceDifference> found;
    double most = 0;
    const auto compare = [&](const std::string& row) {
        const auto* cell = first_difference(left, right, most);
        if (cell && !found)
            found = {a.line(), row, cell->first, text_at(left, cell->first), text_at(right, cell->first)};
        return cell != nullptr;
    };
    compare("the heading");
    for (rows = 0;; ++rows) {
        give_up_if_interrupted();
        const bool has_left = a.read(left), has_right = b.read(right);
        if (has_left != has_right && !found)
            found = {a.line(), called(has_left ? left : right), "the row", has_left ? "there" : "missing",
                     has_right ? "there" : "missing"};
        if (!has_left || !has_right) break;
        if (compare(called(left))) ++found->rows;
    }
    if (found) found->most = most;
    return found;
}

} // namespace sinew::cli

#include "sinew/prefab/obj.h"

#include "sinew/math/format.h"
#include "sinew/math/limit.h"
#include "sinew/math/random.h"
#include "sinew/math/sort.h"
#include "sinew/prefab/obj_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <unordered_map>

namespace sinew {
namespace {

/// Largest absolute coordinate accepted.
constexpr double furthest = 1e6;
constexpr std::size_t max_shown = 40; ///< bytes of the offending word in a message

constexpr std::array<std::string_view, 12> passed_over = {"vn", "vt", "vp", "o",      "g",      "s",
                                                          "l",  "p",  "mg", "usemtl", "mtllib", "usemap"};

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

/// Removes and returns the first word of a line.
std::string_view take_word(std::string_view& line) {
    while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
    std::size_t end = 0;
    while (end < line.size() && !is_blank(line[end])) ++end;
    const auto word = line.substr(0, end);
    line.remove_prefix(end);
    return word;
}

/// The offending word for a message: printable and cut to `max_shown`.
std::string shown(std::string_view word) {
    if (word.empty()) return "nothing";
    std::string text;
    for (const char c : word.substr(0, max_shown)) text += c >= ' ' && c <= '~' ? c : '?';
    return format_text("\"{}{}\"", text, word.size() > max_shown ? "..." : "");
}

template <class Number> std::optional<Number> parsed(std::string_view word) {
    Number number{};
    const auto* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, number);
    if (error != std::errc() || stop != end) return std::nullopt;
    return number;
}
#if !defined(__cpp_lib_to_chars) // libc++ 19 parses no floating-point numbers
/// A decimal number, correctly rounded as by std::from_chars.
template <> std::optional<double> parsed(std::string_view word) {
    if (word.empty() || word.find_first_not_of("0123456789.eE+-") != std::string_view::npos) return std::nullopt;
    const std::string text(word);
    char* end = nullptr;
    const double number = std::strtod(text.c_str(), &end);
    if (end != text.c_str() + text.size() || !std::isfinite(number)) return std::nullopt;
    return number;
}
#endif

template <class Number> std::optional<Number> number_in(std::string_view word) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    return parsed<Number>(word);
}

class ReadingObj {
  public:
    ReadingObj(std::string_view text, const ObjLimits& limits) : text_(text), limits_(limits) {}

    std::variant<MeshModel, ObjProblem> read() {
        std::string joined;
        for (std::size_t lines = 1; !text_.empty() && problem_.empty();) {
            line_ += lines;
            const auto line = take_obj_line(text_, joined, lines);
            read_line(line.substr(0, line.find('#')));
        }
        if (!problem_.empty()) return ObjProblem{line_, problem_};
        if (model_.faces() == 0) return ObjProblem{0, "there is no face in it: no line begins with f"};
        return std::move(model_);
    }

  private:
    std::string_view text_;
    const ObjLimits& limits_;
    std::size_t line_ = 0; ///< of the file: the first of those that are joined
    std::string problem_;
    MeshModel model_;

    void read_line(std::string_view rest) {
        const auto keyword = take_word(rest);
        if (keyword == "v") return read_point(rest);
        if (keyword == "f") return read_face(rest);
        if (keyword.empty() || std::ranges::find(passed_over, keyword) != passed_over.end()) return;
        problem_ = format_text("a line of a mesh begins with v, f or the like, found {}", shown(keyword));
    }

    /// Reads three numbers; a weight or a colour may follow and is ignored.
    void read_point(std::string_view rest) {
        if (model_.points.size() >= limits_.points) {
            problem_ = format_text("more than {} points", limits_.points);
            return;
        }
        Vec3<double> point;
        for (int i = 0; i < 3; ++i) {
            const auto word = take_word(rest);
            const auto number = number_in<double>(word);
            if (!number || !(*number >= -furthest && *number <= furthest)) {
                problem_ = format_text("a coordinate is a number from {:6} to {:6}, found {}", -furthest, furthest,
                                       shown(word));
                return;
            }
            point[i] = *number;
        }
        model_.points.push_back(point);
    }

    void read_face(std::string_view rest) {
        const auto begin = model_.corners.size();
        for (auto word = take_word(rest); !word.empty(); word = take_word(rest)) {
            if (model_.corners.size() >= limits_.corners) {
                problem_ = format_text("more than {} corners of faces", limits_.corners);
                return;
            }
            const auto corner = corner_in(word);
            if (!corner) return;
            model_.corners.push_back(*corner);
        }
        if (model_.corners.size() < begin + 3) {
            problem_ = format_text("a face has three corners or more, found {}", model_.corners.size() - begin);
            return;
        }
        auto sorted = std::vector(model_.corners.begin() + std::ptrdiff_t(begin), model_.corners.end());
        sinew::sort(sorted);
        if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
            problem_ = format_text("a face has each corner once, found point {} twice", *twice + 1);
        model_.ends.push_back(std::uint32_t(model_.corners.size()));
    }

    std::optional<std::uint32_t> corner_in(std::string_view word) {
        const auto number = number_in<std::int64_t>(word.substr(0, word.find('/')));
        const auto points = std::int64_t(model_.points.size());
        const std::int64_t index = !number ? -1 : *number < 0 ? points + *number : *number - 1;
        if (number && index >= 0 && index < points) return std::uint32_t(index);
        problem_ = number
                       ? format_text("there are {} points above this line, found a face of point {}", points, *number)
                       : format_text("a corner is the number of a point, found {}", shown(word));
        return std::nullopt;
    }
};

} // namespace

std::string_view take_obj_line(std::string_view& text, std::string& joined, std::size_t& lines) {
    joined.clear();
    for (lines = 1;; ++lines) {
        const auto end = std::min(text.find('\n'), text.size());
        auto line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        const bool goes_on = line.ends_with('\\') && line.find('#') == line.npos;
        if (!goes_on && lines == 1) return line;
        joined += goes_on ? line.substr(0, line.size() - 1) : line;
        if (!goes_on) return joined;
        joined += ' ';
    }
}

namespace {

/// Points of a model so far of which no two coincide, in cells of a grid.
class FirstPoints {
  public:
    explicit FirstPoints(const std::vector<Vec3<double>>& points) : points_(points) {
        if (points.empty()) return;
        auto high = low_ = points.front();
        for (const auto& point : points)
            for (int k = 0; k < 3; ++k) low_[k] = min(low_[k], point[k]), high[k] = max(high[k], point[k]);
        reach_ = weld_share * norm(high - low_);
        if (reach_ > 0) cell_ = 4 * reach_; // most points are near no other cell
    }

    /// The first point with which point number i coincides: itself, if there is none.
    std::uint32_t first_at(std::uint32_t i) {
        const auto low = cell_of(i, -reach_), high = cell_of(i, reach_);
        auto found = i;
        for (auto x = low[0]; x <= high[0]; ++x)
            for (auto y = low[1]; y <= high[1]; ++y)
                for (auto z = low[2]; z <= high[2]; ++z) found = std::min(found, first_in({x, y, z}, i));
        if (found == i) cells_[cell_of(i, 0)].push_back(i);
        return found;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;
    struct CellHash {
        std::size_t operator()(const Cell& cell) const {
            std::uint64_t mixed = 0;
            for (const auto number : cell) mixed = random::mix(mixed ^ std::uint64_t(number));
            return std::size_t(mixed);
        }
    };

    const std::vector<Vec3<double>>& points_;
    Vec3<double> low_{};
    double reach_ = 0, cell_ = 1;
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells_;

    Cell cell_of(std::uint32_t i, double beside) const {
        Cell cell{};
        for (int k = 0; k < 3; ++k)
            cell[std::size_t(k)] = std::int64_t(std::floor((points_[i][k] - low_[k] + beside) / cell_));
        return cell;
    }
    std::uint32_t first_in(const Cell& cell, std::uint32_t i) const {
        const auto known = cells_.find(cell);
        if (known == cells_.end()) return i;
        for (const auto other : known->second)
            if (norm(points_[other] - points_[i]) <= reach_) return other;
        return i;
    }
};

} // namespace

std::variant<MeshModel, ObjProblem> read_obj(std::string_view text, const ObjLimits& limits) {
    return ReadingObj(text, limits).read();
}

MeshModel weld(const MeshModel& model) {
    const auto count = model.points.size();
    std::vector<std::uint32_t> first(count), becomes(count);
    FirstPoints known(model.points);
    for (std::uint32_t i = 0; i < count; ++i) first[i] = known.first_at(i);
    MeshModel welded;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (first[i] != i) continue;
        becomes[i] = std::uint32_t(welded.points.size());
        welded.points.push_back(model.points[i]);
    }
    welded.welded = model.welded + count - welded.points.size();
    for (std::size_t i = 0; i < model.faces(); ++i) {
        const auto begin = welded.corners.size();
        for (const auto corner : model.face(i)) {
            const auto point = becomes[first[corner]];
            if (welded.corners.size() == begin || welded.corners.back() != point) welded.corners.push_back(point);
        }
        while (welded.corners.size() > begin + 1 && welded.corners.back() == welded.corners[begin])
            welded.corners.pop_back();
        auto sorted = std::vector(welded.corners.begin() + std::ptrdiff_t(begin), welded.corners.end());
        sinew::sort(sorted);
        if (sorted.size() >= 3 && std::ranges::adjacent_find(sorted) == sorted.end())
            welded.ends.push_back(std::uint32_t(welded.corners.size()));
        else
            welded.corners.resize(begin);
    }
    return welded;
}

std::string to_obj(const MeshModel& model) {
    std::string text;
    for (const auto& point : model.points) text += format_text("v {} {} {}\n", point[0], point[1], point[2]);
    for (std::size_t i = 0; i < model.faces(); ++i) {
        text += 'f';
        for (const auto corner : model.face(i)) text += format_text(" {}", corner + 1);
        text += '\n';
    }
    return text;
}

} // namespace sinew

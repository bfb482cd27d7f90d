#include "sinew/scene/layout.h"

#include <algorithm>
#include <array>

namespace sinew {
namespace {

/// A row of a table.
struct Described {
    std::string name, type, unit, usual, range;
    std::string_view help;
};

/// A table of fields: of a record, or of an alternative inside a record.
struct Section {
    std::string title;
    std::string_view about;
    std::vector<Described> rows;
};

std::string type_text(const Layout& shape) {
    switch (shape.type) {
    case Layout::Type::truth:
        return "true or false";
    case Layout::Type::integer:
        return "integer";
    case Layout::Type::number:
        return "number";
    case Layout::Type::text:
        return shape.field.choices.empty() ? "text" : "word";
    case Layout::Type::point:
        return "point";
    case Layout::Type::list:
        if (shape.min == shape.max) return concat(shape.min, " of ", type_text(shape.parts[0]));
        return concat("list of ", type_text(shape.parts[0]));
    case Layout::Type::map:
        return concat("names of ", type_text(shape.parts[0]));
    case Layout::Type::record:
        return "object";
    case Layout::Type::choice:
        return "word";
    case Layout::Type::any:
        return "any value";
    }
    return {};
}

/// A default value as a file in the given units states it.
json::Value in_units(const json::Value& value, double scale) {
    if (const auto* number = value.as<json::Number>())
        return scale == 1 ? value : json::Value(rounded(number->value * scale));
    const auto* items = value.as<json::Array>();
    if (!items) return value;
    json::Array scaled;
    for (const auto& item : *items) scaled.push_back(in_units(item, scale));
    return scaled;
}

std::string list_of(std::span<const std::string_view> words) {
    std::string text;
    for (const auto word : words) text += concat(text.empty() ? "" : ", ", word);
    return text;
}

std::string usual_text(const Layout& shape, const Units& units) {
    if (shape.field.required) return "required";
    if (shape.usual.is_null()) return shape.optional || shape.type != Layout::Type::record ? "none" : "";
    if (shape.usual == json::Value("")) return "none";
    const auto* text = shape.usual.as<std::string>();
    return text ? *text : to_text(in_units(shape.usual, units.scale(shape.field.unit)));
}

std::string range_of(const Layout& shape, const Units& units) {
    if (!shape.field.choices.empty()) return list_of(shape.field.choices);
    const auto [low, high] = range_in_file(shape.field, units);
    if (is_finite(low) && is_finite(high)) return concat(number_text(low), " to ", number_text(high));
    if (is_finite(low)) return concat("at least ", number_text(low));
    if (is_finite(high)) return concat("at most ", number_text(high));
    return {};
}

Described row_of(const Layout& shape, std::string name, const Units& units) {
    return {std::move(name),          type_text(shape),       units.text(shape.field.unit),
            usual_text(shape, units), range_of(shape, units), shape.field.help};
}

/// The record inside a field, however deeply nested in lists and maps, and the prefix of its fields' names.
struct Inside {
    const Layout* record;
    std::string prefix;
};

Inside inside(const Layout& shape, std::string name) {
    const bool list = shape.type == Layout::Type::list, map = shape.type == Layout::Type::map;
    if (shape.type == Layout::Type::record) return {&shape, concat(name, ".")};
    if (list || map) return inside(shape.parts[0], concat(name, list ? "[]" : ".NAME"));
    return {nullptr, {}};
}

void add_fields(std::vector<Section>& sections, std::size_t section, const Layout& record, const std::string& prefix,
                const Units& units);

void add_choice(std::vector<Section>& sections, std::size_t section, const Layout& choice, const std::string& prefix,
                const Units& units) {
    const std::string tag(choice.field.name);
    std::vector<std::string_view> names;
    for (const auto& alternative : choice.parts) names.push_back(alternative.name);
    if (!tag.empty()) {
        Described row = row_of(choice, prefix + tag, units);
        row.range = list_of(names);
        sections[section].rows.push_back(std::move(row));
    }
    for (const auto& alternative : choice.parts) {
        const auto title = concat(prefix, tag, tag.empty() ? "" : " = ", alternative.name);
        sections.push_back({title, alternative.about, {}});
        add_fields(sections, sections.size() - 1, alternative, prefix, units);
    }
}

void add_fields(std::vector<Section>& sections, std::size_t section, const Layout& record, const std::string& prefix,
                const Units& units) {
    for (const auto& field : record.parts) {
        if (field.type == Layout::Type::choice) {
            add_choice(sections, section, field, prefix, units);
            continue;
        }
        const auto name = concat(prefix, field.field.name);
        sections[section].rows.push_back(row_of(field, name, units));
        if (const auto [within, names] = inside(field, name); within)
            add_fields(sections, section, *within, names, units);
    }
}

std::vector<Section> sections_of(const Layout& record, const Units& units) {
    std::vector<Section> sections{{std::string(record.name), record.about, {}}};
    add_fields(sections, 0, record, "", units);
    return sections;
}

std::array<std::string, 5> cells(const Described& row) {
    const auto type = concat(row.type, row.unit.empty() ? "" : ", ", row.unit);
    return {row.name, type, row.usual, row.range, std::string(row.help)};
}

constexpr std::array<std::string_view, 5> headings = {"name", "type", "default", "range", "meaning"};

std::array<std::size_t, 5> widths_of(const std::vector<Described>& rows) {
    constexpr std::size_t widest = 32;
    std::array<std::size_t, 5> widths{};
    for (std::size_t i = 0; i < widths.size(); ++i) {
        widths[i] = headings[i].size();
        for (const auto& row : rows) widths[i] = std::max(widths[i], std::min(cells(row)[i].size(), widest));
    }
    return widths;
}

/// Aligns cells in columns. A cell wider than its column shifts the following cells to the right.
template <class Cells> std::string columns(const Cells& cells, const std::array<std::size_t, 5>& widths) {
    std::string line;
    for (std::size_t i = 0, column = 0; i < widths.size(); ++i) {
        line += concat("  ", cells[i]);
        column += widths[i] + 2;
        if (line.size() < column) line.resize(column, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    return concat(line, "\n");
}

std::string cell(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '|') escaped += '\\';
        escaped += c;
    }
    return escaped;
}

} // namespace

std::string describe(const Layout& record, const Units& units) {
    std::string out;
    for (const auto& [title, about, rows] : sections_of(record, units)) {
        if (!out.empty()) out += "\n";
        if (!title.empty()) out += concat(title, about.empty() ? "" : ": ", about, "\n");
        if (rows.empty()) continue;
        const auto widths = widths_of(rows);
        out += columns(headings, widths);
        for (const auto& row : rows) out += columns(cells(row), widths);
    }
    return out;
}

std::string describe_markdown(const Layout& record, const Units& units) {
    std::string out;
    for (const auto& [title, about, rows] : sections_of(record, units)) {
        if (!out.empty()) out += "\n";
        if (!title.empty()) out += concat("### `", title, "`\n\n", about, about.empty() ? "" : "\n\n");
        if (rows.empty()) continue;
        out += "| name | type | default | range | meaning |\n|---|---|---|---|---|\n";
        for (const auto& row : rows) {
            auto texts = cells(row);
            texts[0] = concat("`", texts[0], "`");
            for (const auto& text : texts) out += concat("| ", cell(text), " ");
            out += "|\n";
        }
    }
    return out;
}

} // namespace sinew

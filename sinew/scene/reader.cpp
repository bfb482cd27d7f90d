#include "sinew/scene/reader.h"

#include "sinew/scene/foreign_words.h"

#include <algorithm>

namespace sinew {

std::string Path::text() const {
    if (!parent_) return {};
    constexpr std::size_t longest = 500; // bytes; keys can be long
    std::string text = parent_->text();
    if (text.size() > longest) return text;
    return concat(text, is_index_ ? concat("/", index_) : json::pointer_step(key_.substr(0, longest)));
}

namespace detail {
namespace {

std::string help_of(const Field& field) {
    if (field.help.empty()) return {};
    return concat(field.name, field.name.empty() ? "" : ": ", field.help);
}

/// Expectation of a message: "a number from 0 to 100 px"
std::string expected_number(std::string_view noun, const Range& range, const Field& field, const Reading& in) {
    const auto limits = range_text(range);
    const auto unit = in.units.text(field.unit);
    const auto between = unit.empty() ? "" : limits.empty() ? " in " : " ";
    return concat(noun, limits.empty() ? "" : " ", limits, between, unit);
}

/// `"a", "b" or "c"`, or only the number of words where there are many; the help line lists them.
std::string one_of(std::span<const std::string_view> words) {
    constexpr std::size_t max = 4;
    if (words.size() > max) return concat("one of ", words.size(), " words");
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += concat(i == 0 ? "" : i + 1 < words.size() ? ", " : " or ", in_quotes(words[i]));
    return text;
}

/// True if one more message is stored; otherwise counts the error.
bool room(const Reading& in) {
    if (!in.diagnostics.full()) return true;
    in.diagnostics.count_one_more();
    return false;
}

Span opening_brace(const json::Value& object) {
    return {object.span.source, object.span.begin, std::min(object.span.begin + 1, object.span.end)};
}

} // namespace

bool refuse(const json::Value& value, const Field& field, const Path& path, const Reading& in,
            std::string_view expected) {
    if (room(in))
        in.diagnostics.error(value.span, path.text(), concat("expected ", expected, ", found ", json::describe(value)),
                             help_of(field));
    return false;
}

bool read_truth(const json::Value& value, bool& target, const Field& field, const Path& path, const Reading& in) {
    const auto* truth = value.as<bool>();
    if (!truth) return refuse(value, field, path, in, "true or false");
    target = *truth;
    return true;
}

bool read_number(const json::Value& value, double& target, const Field& field, const Path& path, const Reading& in) {
    const Range range = range_in_file(field, in.units);
    const auto* number = value.as<json::Number>();
    if (!number || number->value < range.low || number->value > range.high)
        return refuse(value, field, path, in, expected_number("a number", range, field, in));
    constexpr double largest = 1e30; // largest number accepted in any unit, within the range of float
    if (absolute(number->value) > largest)
        return refuse(value, field, path, in, expected_number("a number", {-largest, largest}, field, in));
    target = number->value * in_program(field.unit);
    return true;
}

bool read_integer(const json::Value& value, std::int64_t& target, Range range, const Field& field, const Path& path,
                  const Reading& in) {
    const auto* number = value.as<json::Number>();
    if (!number || !number->integer || number->value < range.low || number->value > range.high)
        return refuse(value, field, path, in, expected_number("an integer", range, field, in));
    target = *number->integer;
    return true;
}

bool read_string(const json::Value& value, std::string& target, const Field& field, const Path& path,
                 const Reading& in) {
    const auto* text = value.as<std::string>();
    const bool any = field.choices.empty();
    if (text && (any || std::ranges::find(field.choices, *text) != field.choices.end())) {
        target = *text;
        return true;
    }
    if (any) return refuse(value, field, path, in, "a string");
    if (!room(in)) return false;
    const std::vector<std::string_view> choices(field.choices.begin(), field.choices.end());
    in.diagnostics.error(value.span, path.text(),
                         concat("expected ", one_of(field.choices), ", found ", json::describe(value)),
                         suggest(text ? std::string_view(*text) : std::string_view(), choices));
    return false;
}

const json::Array* array_of(const json::Value& value, std::size_t size, const Field& field, const Path& path,
                            const Reading& in) {
    const auto* items = value.as<json::Array>();
    if (items && items->size() == size) return items;
    refuse(value, field, path, in, concat("an array of ", size));
    return nullptr;
}

bool take_memory(const json::Value& list, std::size_t count, std::size_t bytes_each, const Path& path,
                 const Reading& in) {
    const auto bytes = std::int64_t(count * bytes_each);
    if (bytes > in.memory) {
        if (room(in))
            in.diagnostics.error(
                list.span, path.text(),
                concat("a list of ", count, " takes ", bytes, " bytes, of which only ", in.memory, " are left"),
                "limits.memory=N allows more");
        return false;
    }
    in.memory -= bytes;
    return true;
}

void report_missing(const json::Value& object, const Field& field, const Path& path, const Reading& in) {
    if (room(in))
        in.diagnostics.error(opening_brace(object), path.text(), concat("missing property ", in_quotes(field.name)),
                             help_of(field));
}

/// "did you mean "a.b" or "c" at the top of the file?"; empty without a path.
std::string suggested_paths(const std::vector<std::string>& paths) {
    constexpr std::size_t max_told = 4;
    const auto is_key = [](const std::string& path) { return path.find_first_of("./") == path.npos; };
    if (paths.empty()) return "";
    std::string help = "did you mean ";
    for (std::size_t i = 0; i < std::min(paths.size(), max_told); ++i)
        help += concat(i == 0 ? "" : " or ", in_quotes(paths[i]), is_key(paths[i]) ? " at the top of the file" : "");
    if (paths.size() > max_told) help += concat(", or at ", paths.size() - max_told, " more places");
    return help + "?";
}

/// Paths at which a key of a file is allowed, or Sinew's word for the key: in the records around, or else in other
/// sections.
std::vector<std::string> paths_for(std::string_view key, const Path& path, const Reading& in) {
    if (in.around)
        if (auto around = in.around(path.text(), key); !around.empty()) return around;
    if (!in.in_sections) return {};
    auto paths = in.in_sections(key);
    for (const auto word : own_names(key))
        for (auto& path : in.in_sections(word)) paths.push_back(std::move(path));
    return paths;
}

/// Help for an unknown key. An override has no surrounding file to look at, so its author gets full paths.
std::string help_with(const json::Member& member, const std::vector<std::string_view>& allowed, const Path& path,
                      const Reading& in) {
    constexpr std::uint32_t file = 0;
    const auto renamed = new_name(member.key);
    const auto word = renamed.empty() ? std::string_view(member.key) : renamed;
    const bool is_in_section = member.key_span.source == file && in.in_sections && !in.in_sections(word).empty();
    const bool is_near = std::ranges::find(allowed, word) != allowed.end() || !own_name(word, allowed).empty() ||
                         (!is_in_section && !nearest(word, allowed).empty());
    if (is_near) return suggest(member.key, allowed);
    if (member.key_span.source == file) {
        const auto paths = suggested_paths(paths_for(member.key, path, in));
        return concat(paths, paths.empty() ? "" : " ", suggest({}, allowed));
    }
    const auto paths = in.elsewhere ? suggested_paths(in.elsewhere(member.key)) : std::string();
    return paths.empty() ? suggest(member.key, allowed) : paths;
}

bool report_unknown(const json::Object& object, const std::vector<std::string_view>& allowed, const Path& path,
                    const Reading& in) {
    bool any = false;
    for (const auto& member : object) {
        if (std::ranges::find(allowed, member.key) != allowed.end()) continue;
        any = true;
        if (room(in))
            in.diagnostics.error(member.key_span, path.text(), concat("unknown property ", in_quotes(member.key)),
                                 help_with(member, allowed, path, in));
    }
    return any;
}

void FieldReader::read_fields(AnyRecord record) {
    record.each([&](void* member, const FieldType& type, const Field& field) { type.read(*this, member, field); });
}

const json::Value* FieldReader::taken(const Field& field) {
    allow(field.name);
    if (const auto* member = json::find(object_, field.name)) {
        ++taken_;
        return &member->value;
    }
    if (field.required) {
        good_ = false;
        report_missing(value_, field, path_, in_);
    }
    return nullptr;
}

bool FieldReader::finish() {
    if (good_ && taken_ == object_.size()) return true;
    if (in_.diagnostics.full()) {
        for (auto unknown = object_.size(); unknown > taken_; --unknown) in_.diagnostics.count_one_more();
        return false;
    }
    return !report_unknown(object_, allowed_, path_, in_) && good_;
}

namespace {

std::size_t index_of(std::span<const std::string_view> names, std::string_view name) {
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? none : std::size_t(found - names.begin());
}

/// Chooses an alternative by the value of the tag: {"prefab": "rope"}
std::size_t choose_by_value(const json::Member& tag, const Alternatives& alternatives, const Path& parent,
                            const Reading& in) {
    const Path path(parent, tag.key);
    const auto* word = tag.value.as<std::string>();
    if (!word) return refuse(tag.value, alternatives.field, path, in, "a string"), wrong;
    const auto index = index_of(alternatives.names, *word);
    if (index != none) return index;
    if (in.diagnostics.full())
        in.diagnostics.count_one_more();
    else
        in.diagnostics.error(tag.value.span, path.text(), concat("unknown ", tag.key, " ", in_quotes(*word)),
                             suggest(*word, {alternatives.names.begin(), alternatives.names.end()}));
    return wrong;
}

/// Chooses an alternative by the presence of its key: {"grab": ...}
std::size_t choose_by_key(const json::Object& object, const Alternatives& alternatives, const Path& path,
                          const Reading& in) {
    std::size_t chosen = none;
    for (const auto& member : object) {
        const auto index = index_of(alternatives.names, member.key);
        if (index == none) continue;
        if (chosen != none) {
            if (room(in))
                in.diagnostics.error(member.key_span, path.text(),
                                     concat(in_quotes(member.key), " beside ", in_quotes(alternatives.names[chosen])),
                                     "only one of them can be here");
            return wrong;
        }
        chosen = index;
    }
    return chosen;
}

} // namespace

std::size_t choose(const json::Value& value, const Alternatives& alternatives, const Path& path, const Reading& in) {
    const auto& object = *value.as<json::Object>();
    const Field& field = alternatives.field;
    const auto* tag = field.name.empty() ? nullptr : json::find(object, field.name);
    if (tag) return choose_by_value(*tag, alternatives, path, in);
    const auto chosen = field.name.empty() ? choose_by_key(object, alternatives, path, in) : none;
    if (chosen != none || !field.required) return chosen;

    if (!field.name.empty()) return report_missing(value, field, path, in), wrong;
    if (room(in))
        in.diagnostics.error(opening_brace(value), path.text(),
                             concat("expected a property ", one_of(alternatives.names)),
                             suggest({}, {alternatives.names.begin(), alternatives.names.end()}));
    return wrong;
}

} // namespace detail
} // namespace sinew

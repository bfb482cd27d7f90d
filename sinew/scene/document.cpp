#include "sinew/scene/document.h"

#include "sinew/math/sort.h"
#include "sinew/scene/reader.h"
#include "sinew/scene/utf8.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

namespace sinew {
namespace {

using json::Array;
using json::Member;
using json::Object;
using json::Value;

// --- finding the elements of an array by name -------------------------------------------------------------------

std::string_view text_of(const Value& element, std::string_view key) {
    const auto* object = element.as<Object>();
    const auto* member = object ? json::find(*object, key) : nullptr;
    const auto* text = member ? member->value.as<std::string>() : nullptr;
    return text ? std::string_view(*text) : std::string_view();
}

std::string_view name_of(const Value& element) {
    const auto name = text_of(element, "name");
    return name.empty() ? text_of(element, "prefab") : name;
}

/// Positions of keys with logarithmic lookup. A hostile file can have a patch as long as the patched array, so linear
/// lookup would be quadratic.
class Index {
  public:
    using Entry = std::pair<std::string_view, std::size_t>;
    void add(std::string_view key, std::size_t position) { sorted_.emplace_back(key, position); }
    void sort() { sinew::sort(sorted_.begin(), sorted_.end()); }
    std::span<const Entry> equal(std::string_view key) const {
        const auto before = [](const Entry& a, const Entry& b) { return a.first < b.first; };
        const auto [first, last] = std::equal_range(sorted_.begin(), sorted_.end(), Entry{key, 0}, before);
        return {first, last};
    }

  private:
    std::vector<Entry> sorted_;
};

/// Finds elements of an array by name, by prefab where a single unnamed element has that prefab, or by index.
class ElementNames {
  public:
    explicit ElementNames(const Array& items) : size_(items.size()) {
        for (std::size_t i = 0; i < items.size(); ++i) {
            if (const auto name = text_of(items[i], "name"); !name.empty())
                names_.add(name, i);
            else
                prefabs_.add(text_of(items[i], "prefab"), i);
        }
        names_.sort();
        prefabs_.sort();
    }

    std::optional<std::size_t> find(std::string_view key) const {
        if (const auto named = names_.equal(key); !named.empty()) return named.front().second;
        if (const auto built = prefabs_.equal(key); built.size() == 1) return built.front().second;
        std::size_t index = 0;
        const auto [stop, problem] = std::from_chars(key.data(), key.data() + key.size(), index);
        const bool is_index = problem == std::errc() && stop == key.data() + key.size() && index < size_;
        return is_index ? std::optional(index) : std::nullopt;
    }

  private:
    std::size_t size_;
    Index names_, prefabs_;
};

/// Reports that a key names no element of the array.
void report_no_element(Diagnostics& diagnostics, const Array& items, std::string_view key, Span span,
                       const Path& path) {
    if (diagnostics.full()) return diagnostics.count_one_more();
    std::vector<std::string_view> names;
    for (const auto& item : items)
        if (const auto name = name_of(item); !name.empty()) names.push_back(name);
    const auto help = !names.empty()  ? suggest(key, std::move(names))
                      : items.empty() ? "the array is empty"
                                      : concat("indices go from 0 to ", items.size() - 1);
    diagnostics.error(span, path.text(), concat("nothing here is called ", in_quotes(key)), help);
}

template <class T> void erase_marked(std::vector<T>& items, const std::vector<bool>& marked) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (marked[i]) continue;
        if (kept != i) items[kept] = std::move(items[i]);
        ++kept;
    }
    items.erase(items.begin() + std::ptrdiff_t(kept), items.end());
}

// --- merge patches ----------------------------------------------------------------------------------------------

void merge(Value& target, const Value& patch, const Path& path, Diagnostics& diagnostics);

/// A patch without nulls: the value to insert where the target has no such member.
Value without_nulls(const Value& patch) {
    const auto* members = patch.as<Object>();
    if (!members) return patch;
    Object kept;
    for (const auto& member : *members)
        if (!member.value.is_null()) kept.push_back({member.key, without_nulls(member.value), member.key_span});
    Value value(std::move(kept));
    value.span = patch.span;
    return value;
}

/// The element each member of the patch refers to, looked up before any element changes.
std::vector<std::optional<std::size_t>> elements_meant(const Array& items, const Object& patch) {
    const ElementNames names(items);
    std::vector<std::optional<std::size_t>> meant;
    for (const auto& member : patch) meant.push_back(names.find(member.key));
    return meant;
}

void merge_into_array(Array& items, const Object& patch, const Path& path, Diagnostics& diagnostics) {
    const auto meant = elements_meant(items, patch);
    std::vector<bool> removed(items.size());
    for (std::size_t i = 0; i < patch.size(); ++i) {
        const auto& [key, value, span] = patch[i];
        if (!meant[i])
            report_no_element(diagnostics, items, key, span, path);
        else if (value.is_null())
            removed[*meant[i]] = true;
        else
            merge(items[*meant[i]], value, Path(path, *meant[i]), diagnostics);
    }
    erase_marked(items, removed);
}

void merge_into_object(Object& members, const Object& patch, const Path& path, Diagnostics& diagnostics) {
    Index present;
    for (std::size_t i = 0; i < members.size(); ++i) present.add(members[i].key, i);
    present.sort();
    Object added;
    std::vector<bool> removed(members.size());
    for (const auto& [key, value, span] : patch) {
        const auto found = present.equal(key);
        if (found.empty() && !value.is_null()) added.push_back({key, without_nulls(value), span});
        if (found.empty()) continue;
        auto& member = members[found.front().second];
        if (value.is_null())
            removed[found.front().second] = true;
        else
            merge(member.value, value, Path(path, member.key), diagnostics);
    }
    erase_marked(members, removed);
    members.insert(members.end(), std::move_iterator(added.begin()), std::move_iterator(added.end()));
}

void merge(Value& target, const Value& patch, const Path& path, Diagnostics& diagnostics) {
    const auto* changes = patch.as<Object>();
    auto* items = target.as<Array>();
    auto* members = target.as<Object>();
    if (changes && items)
        merge_into_array(*items, *changes, path, diagnostics);
    else if (changes && members)
        merge_into_object(*members, *changes, path, diagnostics);
    else
        target = without_nulls(patch);
}

/// Applies the patch of the document's mode and removes "modes". A patch for an unknown mode is an error.
void apply_mode(Document& document) {
    auto& root = *document.root.as<Object>();
    const auto found = std::ranges::find(root, "modes", &Member::key);
    if (found == root.end()) return;
    const Member patches = std::move(*found);
    root.erase(found);

    const Path top;
    const Path path(top, "modes");
    const auto* by_mode = patches.value.as<Object>();
    if (!by_mode) {
        document.diagnostics.error(patches.value.span, path.text(),
                                   concat("expected an object, found ", json::describe(patches.value)));
        return;
    }
    for (const auto& [mode, patch, span] : *by_mode) {
        if (std::ranges::find(modes, mode) == modes.end())
            document.diagnostics.error(span, path.text(), concat("unknown mode ", in_quotes(mode)),
                                       suggest(mode, {modes.begin(), modes.end()}));
        else if (!patch.as<Object>())
            document.diagnostics.error(patch.span, Path(path, mode).text(),
                                       concat("expected an object, found ", json::describe(patch)));
        else if (const auto* change = json::find(patch, "/solver/mode"))
            document.diagnostics.error(change->span, concat(Path(path, mode).text(), "/solver/mode"),
                                       "a mode's patch cannot change the mode");
        else if (mode == document.mode)
            merge(document.root, patch, Path{}, document.diagnostics);
    }
}

// --- overrides --------------------------------------------------------------------------------------------------

struct Step {
    std::string key;
    Span span;
};

/// A parsed override. Spans refer to the override's own source.
struct Assignment {
    std::vector<Step> steps;
    Value value;
    std::string_view first() const { return steps[0].key; }
};

std::vector<Step> steps_of(std::string_view path, std::uint32_t source) {
    std::vector<Step> steps;
    for (std::size_t begin = 0; begin <= path.size();) {
        const auto end = std::min(path.find('.', begin), path.size());
        steps.push_back(
            {std::string(path.substr(begin, end - begin)), {source, std::uint32_t(begin), std::uint32_t(end)}});
        begin = end + 1;
    }
    if (steps.size() == 1 && (steps[0].key == "mode" || steps[0].key == "precision"))
        steps.insert(steps.begin(), {"solver", steps[0].span});
    return steps;
}

void shift(Value& value, std::uint32_t source, std::uint32_t by) {
    const auto moved = [&](Span span) { return Span{source, span.begin + by, span.end + by}; };
    value.span = moved(value.span);
    if (auto* items = value.as<Array>())
        for (auto& item : *items) shift(item, source, by);
    if (auto* members = value.as<Object>())
        for (auto& member : *members) {
            member.key_span = moved(member.key_span);
            shift(member.value, source, by);
        }
}

/// Reports the first mistake of a value that was meant as JSON: that opens a list, an object or a string, or is a
/// number beyond all numbers. False for any other text, which is a word.
bool report_broken(std::string_view text, const Diagnostics& told, std::uint32_t source, std::uint32_t begin,
                   const std::vector<Step>& steps, Diagnostics& diagnostics) {
    const auto all = told.in_order();
    if (all.empty() || text.empty()) return false;
    auto [span, path, message, help] = all.front();
    const bool opens = std::string_view("[{\"").find(text.front()) != std::string_view::npos;
    if (!opens && !message.starts_with("the number ")) return false;
    if (const std::string_view file = "the file"; message.starts_with(file))
        message.replace(0, file.size(), "the value");
    std::string place;
    for (const auto& step : steps) place += json::pointer_step(step.key);
    diagnostics.error({source, begin + span.begin, begin + span.end}, std::move(place), std::move(message),
                      std::move(help));
    return true;
}

/// Parses a text as JSON; a text that is no JSON becomes a string. Nothing for broken JSON, which is reported.
std::optional<Value> value_of(std::string_view text, std::uint32_t source, std::uint32_t begin,
                              const std::vector<Step>& steps, const Limits& limits, Diagnostics& diagnostics) {
    Diagnostics told;
    if (auto value = json::parse(told.add_source({}, std::string(text)), told, limits); value && told.ok()) {
        shift(*value, source, begin);
        return std::move(*value);
    }
    if (report_broken(text, told, source, begin, steps, diagnostics)) return {};
    Value value(text);
    value.span = {source, begin, begin + std::uint32_t(text.size())};
    return value;
}

std::optional<Assignment> take_apart(const Override& override, Diagnostics& diagnostics, const Limits& limits) {
    const auto source = diagnostics.add_source(override.origin, override.pair);
    const std::string_view pair = override.pair;
    const auto equals = pair.find('=');
    if (equals == std::string_view::npos || equals == 0) {
        diagnostics.error({source, 0, std::uint32_t(pair.size())}, "",
                          concat("expected key=value, found ", in_quotes(pair)), "for example solver.substeps=16");
        return {};
    }
    if (const auto broken = utf8::first_broken(pair); broken != pair.size()) {
        const auto at = std::uint32_t(broken);
        diagnostics.error({source, at, at + 1}, "", "not UTF-8");
        return {};
    }
    if (std::int64_t(pair.size()) > limits.string_bytes || std::ranges::count(pair, '.') > limits.depth) {
        diagnostics.error({source, 0, std::uint32_t(equals)}, "", "longer than any value of a scene");
        return {};
    }
    auto steps = steps_of(pair.substr(0, equals), source);
    auto value = value_of(pair.substr(equals + 1), source, std::uint32_t(equals + 1), steps, limits, diagnostics);
    if (!value) return {};
    return Assignment{std::move(steps), std::move(*value)};
}

/// Sets the value at the end of the steps and creates missing objects along the path. Unknown keys are left for the
/// reader to report.
void assign(Value& target, std::span<const Step> steps, const Value& value, const Path& path,
            Diagnostics& diagnostics) {
    if (steps.empty()) {
        target = value;
        return;
    }
    const Step& step = steps[0];
    const auto rest = steps.subspan(1);
    if (auto* items = target.as<Array>()) {
        const auto index = ElementNames(*items).find(step.key);
        if (!index) return report_no_element(diagnostics, *items, step.key, step.span, path);
        if (rest.empty() && value.is_null())
            items->erase(items->begin() + std::ptrdiff_t(*index));
        else
            assign((*items)[*index], rest, value, Path(path, *index), diagnostics);
        return;
    }
    auto* members = target.as<Object>();
    if (!members)
        return diagnostics.error(step.span, path.text(),
                                 concat(json::describe(target), " has no property ", in_quotes(step.key)));
    if (rest.empty() && value.is_null()) {
        std::erase_if(*members, [&](const Member& member) { return member.key == step.key; });
        return;
    }
    auto* member = json::find(*members, step.key);
    if (!member) {
        Value object{Object{}};
        object.span = step.span;
        members->push_back({step.key, std::move(object), step.span});
        member = &members->back();
    }
    member->key_span = rest.empty() ? step.span : member->key_span;
    assign(member->value, rest, value, Path(path, step.key), diagnostics);
}

/// Reads the assignments to "limits." and removes them from the list.
Limits take_limits(std::vector<Assignment>& assignments, Diagnostics& diagnostics) {
    Value given{Object{}};
    for (const auto& assignment : assignments)
        if (assignment.first() == "limits")
            assign(given, std::span(assignment.steps).subspan(1), assignment.value, Path{}, diagnostics);
    std::erase_if(assignments, [](const Assignment& a) { return a.first() == "limits"; });
    Limits limits;
    const Path root;
    read(given, limits, Field{}, Path(root, "limits"), Reading{diagnostics});
    return limits;
}

/// Mode of the last assignment to solver.mode, else of the document.
std::string mode_of(const Document& document, const std::vector<Assignment>& assignments) {
    std::string mode(modes[0]);
    const auto take = [&](const Value* value) {
        const auto* word = value ? value->as<std::string>() : nullptr;
        if (word && std::ranges::find(modes, *word) != modes.end()) mode = *word;
    };
    take(json::find(document.root, "/solver/mode"));
    for (const auto& [steps, value] : assignments)
        if (steps.size() == 2 && steps[0].key == "solver" && steps[1].key == "mode") take(&value);
    return mode;
}

} // namespace

void Document::error(std::string_view pointer, std::string message, std::string help) {
    if (diagnostics.full()) return diagnostics.count_one_more();
    diagnostics.error(span_at(pointer), std::string(pointer), std::move(message), std::move(help));
}

void Document::warn(std::string_view pointer, std::string message, std::string help) {
    diagnostics.warn(span_at(pointer), std::string(pointer), std::move(message), std::move(help));
}

/// Place of the value at a pointer, or of the innermost value around it.
Span Document::span_at(std::string_view pointer) const {
    const Value* value = json::find(root, pointer);
    while (!value) {
        pointer = pointer.substr(0, std::min(pointer.rfind('/'), pointer.size() - 1));
        value = json::find(root, pointer);
    }
    return value->span;
}

Document load(std::string text, std::string name, std::span<const Override> overrides) {
    Document document;
    auto& diagnostics = document.diagnostics;
    const auto file = diagnostics.add_source(std::move(name), std::move(text));
    std::vector<Assignment> assignments;
    for (const auto& override : overrides)
        if (auto assignment = take_apart(override, diagnostics, document.limits))
            assignments.push_back(std::move(*assignment));
    document.limits = take_limits(assignments, diagnostics);

    document.root = Value(Object{});
    if (auto root = json::parse(file, diagnostics, document.limits)) {
        if (root->as<Object>())
            document.root = std::move(*root);
        else
            diagnostics.error(root->span, "", concat("expected an object, found ", json::describe(*root)));
    }
    document.mode = mode_of(document, assignments);
    std::erase_if(*document.root.as<Object>(), [](const Member& member) { return member.key == "$schema"; });
    apply_mode(document);
    for (const auto& [steps, value] : assignments) assign(document.root, steps, value, Path{}, diagnostics);
    return document;
}

} // namespace sinew

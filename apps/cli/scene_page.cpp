#include "apps/cli/scene_page.h"

#include "sinew/scene/check.h"
#include "sinew/scene/layout.h"

#include "apps/cli/scene_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace sinew::cli {
namespace {

/// Field of a record, or of the chosen alternative of a choice, for a key; null for a choice's tag.
const Layout* field_called(const Layout& record, const json::Object& object, std::string_view key) {
    for (const auto& part : record.parts) {
        if (part.type != Layout::Type::choice) {
            if (part.field.name == key) return &part;
            continue;
        }
        if (part.field.name == key) return nullptr;
        for (const auto& alternative : part.parts) {
            const auto* tag = part.field.name.empty() ? nullptr : json::find(object, part.field.name);
            const bool chosen = part.field.name.empty() ? json::find(object, alternative.name) != nullptr
                                                        : tag && tag->value == json::Value(alternative.name);
            const auto* found = chosen ? field_called(alternative, object, key) : nullptr;
            if (found) return found;
        }
    }
    return nullptr;
}

/// Key of a list element in an override: the name, or the prefab if unique, or the index.
std::string step_of(const json::Array& list, std::size_t index) {
    const auto text = [&](std::size_t i, std::string_view key) -> const std::string* {
        const auto* value = json::find(list[i], concat("/", key));
        return value ? value->as<std::string>() : nullptr;
    };
    if (const auto* name = text(index, "name")) return *name;
    const auto* prefab = text(index, "prefab");
    std::size_t alike = 0;
    for (std::size_t i = 0; i < list.size(); ++i)
        alike += prefab && !text(i, "name") && text(i, "prefab") && *text(i, "prefab") == *prefab;
    return alike == 1 ? *prefab : std::to_string(index);
}

class Collector {
  public:
    Collector(const Units& units, std::vector<Parameter>& found) : units_(units), found_(found) {}

    void record(const json::Object& object, const Layout& shape, const std::string& path) {
        for (const auto& [key, value, span] : object)
            if (const auto* field = field_called(shape, object, key)) this->value(value, *field, path + key);
    }

  private:
    const Units& units_;
    std::vector<Parameter>& found_;
    std::set<std::string> kinds_; ///< kinds reported so far: of five equal chains only the first is
    bool listed_ = false;         ///< inside an element of a list: nested lists, such as points, are not reported

    /// True for the first element of a prefab or driver, or an element without a kind.
    bool is_first_of_its_kind(const json::Object& element) {
        for (const std::string_view key : {"prefab", "driver"})
            if (const auto* kind = json::find(element, key))
                if (const auto* name = kind->value.as<std::string>()) return kinds_.insert(*name).second;
        return !json::find(element, "particle"); // a pin without a driver has nothing to report
    }

    void value(const json::Value& value, const Layout& shape, const std::string& path) {
        using Type = Layout::Type;
        if (const auto* object = value.as<json::Object>(); object && shape.type == Type::record)
            return record(*object, shape, path + ".");
        const bool records = shape.type == Type::list && shape.parts[0].type == Type::record;
        if (const auto* items = value.as<json::Array>(); items && records && !listed_) {
            listed_ = true;
            for (std::size_t i = 0; i < items->size(); ++i)
                if (const auto* object = (*items)[i].as<json::Object>(); object && is_first_of_its_kind(*object))
                    record(*object, shape.parts[0], fmt::format("{}.{}.", path, step_of(*items, i)));
            listed_ = false;
        }
        if (records || shape.type == Type::map || value.as<json::Object>() || shape.field.name == "name") return;
        const auto* text = value.as<std::string>();
        found_.push_back(
            {path, text ? *text : json::to_text(value), units_.text(shape.field.unit), std::string(shape.field.help)});
    }
};

std::string count_text(std::size_t count, std::string_view thing) {
    if (thing == ByHand::name) return count == 1 ? "a figure by hand" : fmt::format("{} figures by hand", count);
    std::string words(thing);
    std::ranges::replace(words, '_', ' ');
    if (words.ends_with('s')) return count == 1 ? words : fmt::format("{} groups of {}", count, words);
    const bool vowel = std::string_view("aeiou").find(words[0]) != std::string_view::npos;
    if (count == 1) return fmt::format("{} {}", vowel ? "an" : "a", words);
    return fmt::format("{} {}{}", count, words, words.ends_with('x') ? "es" : "s");
}

std::string made_of(const Scene& scene) {
    std::vector<std::pair<std::string_view, std::size_t>> counts;
    for (const auto& figure : scene.figures)
        detail::visit_held(figure.made, [&](const auto& made) {
            const auto known = std::ranges::find(counts, made.name, &std::pair<std::string_view, std::size_t>::first);
            if (known == counts.end())
                counts.emplace_back(made.name, 1);
            else
                ++known->second;
        });
    std::string text;
    for (const auto& [name, count] : counts) text += (text.empty() ? "" : ", ") + count_text(count, name);
    return text;
}

} // namespace

ScenePage page_of(const std::string& name) {
    const auto scene = open_file(name).scene;
    const auto document = open_document(name);
    ScenePage page{.name = name,
                   .about = scene.about,
                   .source = scene.source,
                   .made_of = made_of(scene),
                   .text = std::string(document.diagnostics.source(0).text),
                   .seconds = scene.seconds,
                   .parameters = {}};
    json::Object told;
    for (const std::string_view key : {"world", "solver", "figures", "pins"})
        if (const auto* section = json::find(*document.root.as<json::Object>(), key))
            told.push_back({std::string(key), section->value});
    Collector(scene.measures(), page.parameters).record(told, scene_layout(), "");
    return page;
}

} // namespace sinew::cli

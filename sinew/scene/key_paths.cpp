#include "sinew/scene/key_paths.h"

#include "sinew/scene/diagnostic.h"

#include <algorithm>

namespace sinew {
namespace {

using json::Value;

/// Limits of the search: more elements or paths do not help in a message.
constexpr std::size_t max_elements = 100, max_paths = 100;

const Value* member(const Value* object, std::string_view key) {
    const auto* members = object ? object->as<json::Object>() : nullptr;
    const auto* found = members ? json::find(*members, key) : nullptr;
    return found ? &found->value : nullptr;
}

std::string text_in(const Value* object, std::string_view key) {
    const auto* value = member(object, key);
    const auto* text = value ? value->as<std::string>() : nullptr;
    return text ? *text : std::string();
}

/// Name of an element as overrides address it: its name, its prefab if unique, or its index.
std::string element_name(const json::Array& items, std::size_t index) {
    if (auto name = text_in(&items[index], "name"); !name.empty()) return name;
    auto prefab = text_in(&items[index], "prefab");
    const auto meant = std::ranges::count_if(items, [&](const Value& item) {
        const auto name = text_in(&item, "name");
        return name.empty() ? text_in(&item, "prefab") == prefab : name == prefab;
    });
    return !prefab.empty() && meant == 1 ? prefab : std::to_string(index);
}

/// Walks over every field that the objects of a document can have.
class Walk {
  public:
    explicit Walk(std::string_view key) : key_(key) {}

    std::vector<std::string> paths;
    std::vector<std::string_view> names; ///< names of all fields visited

    void record(const Layout& shape, const Value* value, const std::string& prefix) {
        for (const auto& field : shape.parts) {
            const auto name = field.field.name;
            if (!name.empty()) meet(name, prefix);
            if (field.type == Layout::Type::choice)
                alternatives(field, value, prefix);
            else
                inside(field, member(value, name), concat(prefix, name, "."));
        }
    }

  private:
    std::string_view key_;

    void meet(std::string_view name, const std::string& prefix) {
        names.push_back(name);
        if (name == key_ && paths.size() < max_paths) paths.push_back(concat(prefix, name));
    }

    /// Visits the alternative the object chose, or the default.
    void alternatives(const Layout& choice, const Value* value, const std::string& prefix) {
        const auto tag = choice.field.name;
        const auto* usual = choice.usual.as<std::string>();
        auto chosen = tag.empty() ? std::string() : text_in(value, tag);
        if (chosen.empty() && usual) chosen = *usual;
        for (const auto& alternative : choice.parts)
            if (tag.empty() ? member(value, alternative.name) != nullptr : alternative.name == chosen)
                record(alternative, value, prefix);
    }

    void inside(const Layout& shape, const Value* value, const std::string& prefix) {
        if (shape.type == Layout::Type::record) return record(shape, value, prefix);
        if (shape.type == Layout::Type::list) return list(shape, value, prefix);
        if (shape.type == Layout::Type::map) map(shape, value, prefix);
    }

    void list(const Layout& shape, const Value* value, const std::string& prefix) {
        const auto* items = value ? value->as<json::Array>() : nullptr;
        if (!items || shape.parts[0].type != Layout::Type::record) return;
        for (std::size_t i = 0; i < std::min(items->size(), max_elements); ++i)
            record(shape.parts[0], &(*items)[i], concat(prefix, element_name(*items, i), "."));
    }

    void map(const Layout& shape, const Value* value, const std::string& prefix) {
        const auto* members = value ? value->as<json::Object>() : nullptr;
        if (!members || members->empty()) return inside(shape.parts[0], nullptr, concat(prefix, "NAME."));
        for (std::size_t i = 0; i < std::min(members->size(), max_elements); ++i)
            inside(shape.parts[0], &(*members)[i].value, concat(prefix, (*members)[i].key, "."));
    }
};

} // namespace

std::vector<std::string> exact_key_paths(const Layout& shape, const json::Value& document, std::string_view key) {
    Walk walk(key);
    walk.record(shape, &document, "");
    return walk.paths;
}

std::vector<std::string> key_paths(const Layout& shape, const json::Value& document, std::string_view key) {
    Walk exact(key);
    exact.record(shape, &document, "");
    if (!exact.paths.empty()) return exact.paths;
    const auto renamed = new_name(key);
    const auto near = renamed.empty() ? nearest(key, exact.names) : renamed;
    if (near.empty()) return {};
    return exact_key_paths(shape, document, near);
}

} // namespace sinew

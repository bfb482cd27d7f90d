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

/// Calls visit(field) for the fields of an object: the object's own, and those of the chosen alternatives, or else of
/// the default.
template <class Visit> void each_field(const Layout& shape, const Value* value, Visit&& visit) {
    for (const auto& field : shape.parts) {
        visit(field);
        if (field.type != Layout::Type::choice) continue;
        const auto tag = field.field.name;
        const auto* usual = field.usual.as<std::string>();
        auto chosen = tag.empty() ? std::string() : text_in(value, tag);
        if (chosen.empty() && usual) chosen = *usual;
        for (const auto& alternative : field.parts)
            if (tag.empty() ? member(value, alternative.name) != nullptr : alternative.name == chosen)
                each_field(alternative, value, visit);
    }
}

/// Walks over every field that the objects of a document can have.
class Walk {
  public:
    explicit Walk(std::string_view key) : key_(key) {}

    std::vector<std::string> paths;
    std::vector<std::string_view> names; ///< names of all fields visited

    void record(const Layout& shape, const Value* value, const std::string& prefix) {
        each_field(shape, value, [&](const Layout& field) {
            const auto name = field.field.name;
            if (!name.empty()) meet(name, prefix);
            if (field.type != Layout::Type::choice) inside(field, member(value, name), concat(prefix, name, "."));
        });
    }

  private:
    std::string_view key_;

    void meet(std::string_view name, const std::string& prefix) {
        names.push_back(name);
        if (name == key_ && paths.size() < max_paths) paths.push_back(concat(prefix, name));
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

/// Follows a JSON pointer from the document on, and collects keys in the records on the way.
class Descent {
  public:
    Descent(std::string_view place, std::string_view key) : left_(place), key_(key) {}

    /// Paths of the key, the outermost first.
    std::vector<std::string> paths;

    void go(const Layout& shape, const Value* value, const std::string& prefix) {
        if (shape.type == Layout::Type::record) record(shape, value, prefix);
        if (shape.type == Layout::Type::list) list(shape, value, prefix);
        if (shape.type == Layout::Type::map) map(shape, value, prefix);
    }

  private:
    std::string_view left_; ///< the rest of the pointer
    std::string_view key_;

    /// Takes a step if the pointer goes on with it.
    bool takes(const std::string& step) {
        const bool is_next = left_.starts_with(step) && (left_.size() == step.size() || left_[step.size()] == '/');
        if (is_next) left_.remove_prefix(step.size());
        return is_next;
    }

    void record(const Layout& shape, const Value* value, const std::string& prefix) {
        if (left_.empty()) return;
        std::vector<std::string_view> names;
        const Layout* next = nullptr;
        each_field(shape, value, [&](const Layout& field) {
            const auto name = field.field.name;
            if (!name.empty()) names.push_back(name);
            if (!next && !name.empty() && field.type != Layout::Type::choice && takes(json::pointer_step(name)))
                next = &field;
        });
        const bool has_key = std::ranges::find(names, key_) != names.end();
        const auto word = has_key ? key_ : own_name(key_, names);
        const bool is_key = !word.empty() && word.find(':') == std::string_view::npos; // no value of a key
        if (!prefix.empty() && is_key) paths.push_back(concat(prefix, word));
        if (next) go(*next, member(value, next->field.name), concat(prefix, next->field.name, "."));
    }

    void list(const Layout& shape, const Value* value, const std::string& prefix) {
        const auto* items = value ? value->as<json::Array>() : nullptr;
        for (std::size_t i = 0; items && i < items->size(); ++i)
            if (takes(concat("/", i)))
                return go(shape.parts[0], &(*items)[i], concat(prefix, element_name(*items, i), "."));
    }

    void map(const Layout& shape, const Value* value, const std::string& prefix) {
        const auto* members = value ? value->as<json::Object>() : nullptr;
        for (std::size_t i = 0; members && i < members->size(); ++i)
            if (takes(json::pointer_step((*members)[i].key)))
                return go(shape.parts[0], &(*members)[i].value, concat(prefix, (*members)[i].key, "."));
    }
};

} // namespace

std::vector<std::string> key_paths_around(const Layout& shape, const json::Value& document, std::string_view place,
                                          std::string_view key) {
    Descent descent(place, key);
    descent.go(shape, &document, "");
    return {descent.paths.rbegin(), descent.paths.rend()};
}

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

#include "sinew/scene/document.h"
#include "sinew/scene/layout.h"

#include <algorithm>

namespace sinew {
namespace {

using json::Array;
using json::Object;
using json::Value;

Value schema(const Layout& shape);
Object by_type(const Layout& shape);

/// True if a bound is the same number in every scene's units.
bool same_in_all_units(Unit unit, double bound) {
    unit.angle = false;
    return is_finite(bound) && (unit == unit::none || bound == 0);
}

void add_range(Object& schema, const Field& field) {
    const Range range = range_in_file(field, Units{});
    if (same_in_all_units(field.unit, field.low)) schema.push_back({"minimum", range.low});
    if (same_in_all_units(field.unit, field.high)) schema.push_back({"maximum", range.high});
}

Array words(std::span<const std::string_view> names) {
    return {names.begin(), names.end()};
}

std::string description(const Layout& shape) {
    std::string text(shape.field.help);
    Unit unit = shape.field.unit;
    const bool angle = unit.angle;
    unit.angle = false;
    if (angle) text += unit == unit::none ? " (degrees)" : "";
    return text;
}

Object number(std::string_view type, const Layout& shape) {
    Object schema{{"type", type}};
    add_range(schema, shape.field);
    return schema;
}

Object list(const Layout& shape) {
    Object schema{{"type", "array"}, {"items", by_type(shape.parts[0])}};
    if (shape.min > 0) schema.push_back({"minItems", shape.min});
    if (shape.max != Layout::no_limit) schema.push_back({"maxItems", shape.max});
    return schema;
}

/// A point has as many numbers as the scene has dimensions: 2 or 3.
Object point(const Layout& shape) {
    return {{"type", "array"}, {"items", number("number", shape)}, {"minItems", 2}, {"maxItems", 3}};
}

// --- objects ----------------------------------------------------------------------------------------------------

bool is_choice(const Layout& shape) {
    return shape.type == Layout::Type::choice;
}

/// Collects every key that an object of this layout may have.
void collect_names(std::vector<std::string_view>& names, const Layout& record) {
    for (const auto& field : record.parts) {
        if (!field.field.name.empty()) names.push_back(field.field.name);
        if (is_choice(field))
            for (const auto& alternative : field.parts) collect_names(names, alternative);
    }
}

std::vector<std::string_view> unique(std::vector<std::string_view> names) {
    std::vector<std::string_view> once;
    for (const auto name : names)
        if (std::ranges::find(once, name) == once.end()) once.push_back(name);
    return once;
}

struct Properties {
    Object properties;
    Array required;
};

Properties members_of(const Layout& record) {
    Properties members;
    for (const auto& field : record.parts) {
        if (is_choice(field)) continue;
        members.properties.push_back({std::string(field.field.name), schema(field)});
        if (field.field.required) members.required.push_back(field.field.name);
    }
    return members;
}

/// Schema of the object with one alternative selected, or none. `others` are the keys that do not depend on the choice.
Object consequence(const Layout* alternative, std::vector<std::string_view> others) {
    Object then;
    if (alternative) {
        auto [properties, required] = members_of(*alternative);
        collect_names(others, *alternative);
        then.push_back({"properties", std::move(properties)});
        if (!required.empty()) then.push_back({"required", std::move(required)});
    }
    then.push_back({"propertyNames", Object{{"enum", words(unique(std::move(others)))}}});
    return then;
}

Value has(std::string_view key) {
    return Object{{"required", Array{key}}};
}

/// Adds if-then clauses that tie the object's keys to the selected alternative of one choice.
void add_choice(Array& clauses, const Layout& choice, const std::vector<std::string_view>& others) {
    const auto tag = choice.field.name;
    Array any;
    const Layout* usual = nullptr;
    for (const auto& alternative : choice.parts) {
        Value condition =
            tag.empty() ? has(alternative.name)
                        : Value(Object{{"properties", Object{{std::string(tag), Object{{"const", alternative.name}}}}},
                                       {"required", Array{tag}}});
        clauses.push_back(Object{{"if", std::move(condition)}, {"then", consequence(&alternative, others)}});
        if (tag.empty()) any.push_back(has(alternative.name));
        if (choice.usual == Value(alternative.name)) usual = &alternative;
    }
    if (!tag.empty()) any.push_back(has(tag));
    if (choice.field.required)
        clauses.push_back(Object{{"anyOf", std::move(any)}});
    else
        clauses.push_back(
            Object{{"if", Object{{"not", Object{{"anyOf", std::move(any)}}}}}, {"then", consequence(usual, others)}});
}

/// Keys of the record that do not depend on this choice.
std::vector<std::string_view> names_beside(const Layout& record, const Layout& choice) {
    Layout rest{.field = {}, .usual = {}, .name = {}, .about = {}, .parts = {}};
    std::vector<std::string_view> names;
    for (const auto& field : record.parts)
        if (&field != &choice) rest.parts.push_back(field);
    collect_names(names, rest);
    if (!choice.field.name.empty()) names.push_back(choice.field.name);
    return names;
}

Object record(const Layout& shape) {
    auto [properties, required] = members_of(shape);
    Array clauses;
    for (const auto& field : shape.parts) {
        if (!is_choice(field)) continue;
        if (!field.field.name.empty()) {
            std::vector<std::string_view> names;
            for (const auto& alternative : field.parts) names.push_back(alternative.name);
            Object tag{{"description", field.field.help}, {"enum", words(names)}};
            properties.push_back({std::string(field.field.name), std::move(tag)});
        }
        add_choice(clauses, field, names_beside(shape, field));
    }
    std::vector<std::string_view> names;
    collect_names(names, shape);
    for (const auto name : names)
        if (!json::find(properties, name)) properties.push_back({std::string(name), true});

    Object schema{{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
    if (!required.empty()) schema.push_back({"required", std::move(required)});
    if (!clauses.empty()) schema.push_back({"allOf", std::move(clauses)});
    return schema;
}

Object by_type(const Layout& shape) {
    switch (shape.type) {
    case Layout::Type::truth:
        return {{"type", "boolean"}};
    case Layout::Type::integer:
        return number("integer", shape);
    case Layout::Type::number:
        return number("number", shape);
    case Layout::Type::text:
        if (!shape.field.choices.empty()) return {{"type", "string"}, {"enum", words(shape.field.choices)}};
        return {{"type", "string"}};
    case Layout::Type::point:
        return point(shape);
    case Layout::Type::list:
        return list(shape);
    case Layout::Type::map:
        return {{"type", "object"}, {"additionalProperties", by_type(shape.parts[0])}};
    case Layout::Type::record:
        return record(shape);
    case Layout::Type::choice:
    case Layout::Type::any:
        break;
    }
    return {};
}

Value schema(const Layout& shape) {
    Object schema = by_type(shape);
    if (auto text = description(shape); !text.empty()) schema.insert(schema.begin(), {"description", std::move(text)});
    const bool plain = shape.type != Layout::Type::record && shape.type != Layout::Type::list;
    if (plain && !shape.usual.is_null() && shape.field.unit == unit::none) schema.push_back({"default", shape.usual});
    return schema;
}

} // namespace

json::Value schema_of(const Layout& shape, std::string_view title, bool document) {
    Object schema{{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
    Object root = record(shape);
    if (document) {
        auto& properties = *json::find(root, "properties")->value.as<Object>();
        properties.push_back({"$schema", Object{{"type", "string"}}});
        Object patches;
        for (const auto mode : modes) patches.push_back({std::string(mode), Object{{"type", "object"}}});
        properties.push_back({"modes", Object{{"description", "Changes for each mode, as merge patches of the scene"},
                                              {"type", "object"},
                                              {"properties", std::move(patches)},
                                              {"additionalProperties", false}}});
    }
    schema.insert(schema.end(), std::move_iterator(root.begin()), std::move_iterator(root.end()));
    return schema;
}

} // namespace sinew

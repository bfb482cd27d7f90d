#pragma once

#include "sinew/scene/json.h"
#include "sinew/scene/types.h"
#include "sinew/scene/units.h"
#include "sinew/scene/writer.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace sinew {

/// Description of a record as data, made by one walk over `fields`; help tables, schemas, sliders and forms are made
/// from it.
struct Layout {
    enum class Type { truth, integer, number, text, point, list, map, record, choice, any };

    Type type = Type::any;
    Field field;                         ///< as declared, with ranges in SI units and radians
    json::Value usual;                   ///< the default as a file in SI units states it; null if there is none
    std::size_t min = 0, max = no_limit; ///< range of the number of elements of a list
    std::string_view name;               ///< name of an alternative of a choice
    std::string_view about;              ///< a sentence about an alternative, may be empty
    /// Fields of a record; the one element type of a list or map; the alternatives (records) of a choice.
    std::vector<Layout> parts;
    bool optional = false; ///< may be absent, and no default takes its place

    static constexpr std::size_t no_limit = std::size_t(-1);
};

template <class T> Layout layout_of(const T& value, const Field& field);

template <Record R> Layout layout_of() {
    Layout shape = layout_of(R{}, Field{});
    // Only constants of the type count; a field may have the same name.
    if constexpr (requires { typename std::bool_constant<std::string_view(R::name).empty()>; }) shape.name = R::name;
    if constexpr (requires { typename std::bool_constant<std::string_view(R::about).empty()>; }) shape.about = R::about;
    return shape;
}

namespace detail {

/// Describes the fields of a record.
void describe_record(AnyRecord record, Layout& shape);

/// Describes a value that is neither a choice nor a record: its type, and its elements if any.
template <class T> void describe_value(const T& value, const Field& field, Layout& shape) {
    using Type = Layout::Type;
    if constexpr (std::same_as<T, bool>) {
        shape.type = Type::truth;
    } else if constexpr (Integer<T>) {
        shape.type = Type::integer;
    } else if constexpr (std::floating_point<T>) {
        shape.type = Type::number;
        if (!is_finite(double(value))) shape.usual = {};
    } else if constexpr (std::same_as<T, std::string>) {
        shape.type = Type::text;
    } else if constexpr (std::same_as<T, Point>) {
        shape.type = Type::point;
    } else if constexpr (array_size<T> > 0) {
        shape.type = Type::list;
        shape.min = shape.max = array_size<T>;
        shape.parts = {layout_of(elements(value)[0], element_of(field))};
    } else if constexpr (is_map<T>) {
        shape.type = Type::map;
        shape.parts = {layout_of(typename T::value_type::second_type{}, element_of(field))};
    } else if constexpr (is_vector<T>) {
        shape.type = Type::list;
        shape.parts = {layout_of(typename T::value_type{}, element_of(field))};
    }
}

} // namespace detail

template <class T> Layout layout_of(const T& value, const Field& field) {
    using namespace detail;
    using Type = Layout::Type;
    Layout shape{.field = field, .usual = {}, .name = {}, .about = {}, .parts = {}};
    const Writing plain{.dimension = 2, .units = {}, .defaults = true};
    if constexpr (is_variant<T>) {
        shape.type = Type::choice;
        shape.optional = is_optional<T>;
        each_alternative(std::type_identity<T>{},
                         [&]<class A>(std::type_identity<A>) { shape.parts.push_back(layout_of<A>()); });
        visit_held(value, [&]<Record A>(const A&) { shape.usual = A::name; });
    } else if constexpr (is_optional<T>) {
        using Inside = typename T::value_type;
        shape = layout_of(value ? *value : Inside{}, field);
        shape.optional = true;
        if (!value) shape.usual = {};
    } else if constexpr (Record<T>) {
        shape.type = Type::record;
        describe_record(unchanged(value), shape);
    } else {
        shape.usual = write(value, field, plain);
        describe_value(value, field, shape);
    }
    return shape;
}

/// Layout of a whole scene file.
Layout scene_layout();

/// JSON Schema (draft 07) of a record. `document` adds the keys only a whole scene file may have ("$schema", "modes").
/// Ranges of quantities that depend on a scene's units are omitted.
json::Value schema_of(const Layout& record, std::string_view title, bool document);

/// Plain-text tables of every field: name, unit, default, range, help.
std::string describe(const Layout& record, const Units& units = {});
/// The same tables in Markdown.
std::string describe_markdown(const Layout& record, const Units& units = {});

} // namespace sinew

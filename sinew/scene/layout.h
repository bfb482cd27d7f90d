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

/// What a record looks like, as data: the one walk over `fields` that descriptions, schemas, sliders and forms share.
struct Layout {
    enum class Type { truth, integer, number, text, point, list, map, record, choice, any };

    Type type = Type::any;
    Field field;       ///< as declared; ranges in SI units and radians
    json::Value usual; ///< the default as a file in SI units would state it; null where there is none
    std::size_t least = 0, most = no_limit; ///< elements of a list
    std::string_view name;                  ///< of an alternative of a choice
    std::string_view about;                 ///< one line on an alternative, if it has one
    /// A record's fields; what a list or a map holds (one); a choice's alternatives, which are records.
    std::vector<Layout> parts;
    bool optional = false; ///< can be absent without a default taking its place

    static constexpr std::size_t no_limit = std::size_t(-1);
};

template <class T> Layout layout_of(const T& value, const Field& field);

template <Record R> Layout layout_of() {
    Layout shape = layout_of(R{}, Field{});
    // Constants of the type; fields may have the same names.
    if constexpr (requires { typename std::bool_constant<std::string_view(R::name).empty()>; }) shape.name = R::name;
    if constexpr (requires { typename std::bool_constant<std::string_view(R::about).empty()>; }) shape.about = R::about;
    return shape;
}

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
        T::fields(value, [&](const auto& member, const Field& of) { shape.parts.push_back(layout_of(member, of)); });
    } else {
        shape.usual = write(value, field, plain);
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
            shape.least = shape.most = array_size<T>;
            shape.parts = {layout_of(elements(value)[0], element_of(field))};
        } else if constexpr (is_map<T>) {
            shape.type = Type::map;
            shape.parts = {layout_of(typename T::value_type::second_type{}, element_of(field))};
        } else if constexpr (is_vector<T>) {
            shape.type = Type::list;
            shape.parts = {layout_of(typename T::value_type{}, element_of(field))};
        }
    }
    return shape;
}

/// All that a scene file may say.
Layout scene_layout();

/// A JSON Schema (draft 07) of the record: `document` adds what only a whole scene file may say ("$schema", "modes").
/// Ranges of quantities that depend on a scene's units are left out.
json::Value schema_of(const Layout& record, std::string_view title, bool document);

/// Every field in a table, for people: name, unit, default, range, help.
std::string describe(const Layout& record, const Units& units = {});
/// The same for documentation.
std::string describe_markdown(const Layout& record, const Units& units = {});

} // namespace sinew

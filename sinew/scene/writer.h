#pragma once

#include "sinew/scene/defaults.h"
#include "sinew/scene/json.h"
#include "sinew/scene/types.h"
#include "sinew/scene/units.h"

#include <optional>
#include <string_view>
#include <vector>

/// Converts records to JSON: the inverse of the reader, by the same walk over `fields`.
namespace sinew {

struct Writing {
    int dimension = 2;
    Units units = {};      ///< units of the scene, in which defaults are compared
    bool defaults = false; ///< true: write default values as well
};

namespace detail {
/// Appends required fields and fields that differ from those of `usual`, a record of the same type. The field `key` is
/// always written, because it selects the alternative of a variant.
void write_fields(json::Object& object, AnyRecord record, AnyRecord usual, std::string_view key, const Writing& out);

/// Appends required fields and fields that differ from their defaults.
template <Record R> void write_fields(json::Object& object, const R& record, std::string_view key, const Writing& out) {
    auto usual = fresh<R>({}, out.units);
    write_fields(object, unchanged(record), AnyRecord::of(usual), key, out);
}
} // namespace detail

/// Writes a value of any type a field can have (types.h). An optional must hold a value.
template <class T> json::Value write(const T& value, const Field& field, const Writing& out) {
    using namespace detail;
    if constexpr (std::floating_point<T>) {
        return field.unit.angle ? rounded(double(value) * in_file(field.unit)) : double(value);
    } else if constexpr (std::same_as<T, bool> || Integer<T> || std::same_as<T, std::string> ||
                         std::same_as<T, json::Value>) {
        return value;
    } else if constexpr (std::same_as<T, Point>) {
        json::Array items;
        for (int i = 0; i < out.dimension; ++i) items.push_back(write(value[i], field, out));
        return items;
    } else if constexpr (array_size<T> > 0) {
        json::Array items;
        for (const auto& item : elements(value)) items.push_back(write(item, field, out));
        return items;
    } else if constexpr (is_map<T>) {
        json::Object members;
        for (const auto& [name, item] : value) members.push_back({name, write(item, field, out)});
        return members;
    } else if constexpr (is_vector<T>) {
        json::Array items;
        for (const auto& item : value) items.push_back(write(item, field, out));
        return items;
    } else if constexpr (is_optional<T>) {
        return write(*value, field, out);
    } else {
        static_assert(Record<T>, "types.h lists what a field can be");
        json::Object object;
        write_fields(object, value, {}, out);
        return object;
    }
}

/// Writes a record without its default values.
template <Record R> json::Value write(const R& record, const Writing& out) {
    return write(record, Field{}, out);
}

namespace detail {

template <class T> std::optional<json::Value> write_if_present(const T& value, const Field& field, const Writing& out) {
    if constexpr (is_variant<T>)
        return {};
    else if constexpr (is_optional<T>)
        return value ? std::optional(write(*value, field, out)) : std::nullopt;
    else
        return write(value, field, out);
}

/// Appends the tag of the alternative held, and the alternative's fields.
template <class T>
void write_alternative(const T& variant, const Field& field, json::Object& object, const Writing& out) {
    visit_held(variant, [&]<Record A>(const A& alternative) {
        if (!field.name.empty()) object.push_back({std::string(field.name), A::name});
        write_fields(object, alternative, field.name.empty() ? std::string_view(A::name) : std::string_view(), out);
    });
}

} // namespace detail
} // namespace sinew

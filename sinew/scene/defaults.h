#pragma once

#include "sinew/math/scalar.h"
#include "sinew/scene/walk.h"

namespace sinew::detail {

/// Converts the declared defaults of a record.
void scale_record(AnyRecord record, const Units& units);

/// Converts declared defaults to the units of a scene: each number of the value is multiplied by the scale of its unit.
template <class T> void scale_defaults(T& value, const Field& field, const Units& units) {
    if constexpr (std::floating_point<T>) {
        if (const double scale = units.scale(field.unit); scale != 1) value = T(rounded(double(value) * scale));
    } else if constexpr (std::same_as<T, Point>) {
        for (auto& number : value.component) scale_defaults(number, field, units);
    } else if constexpr (array_size<T> > 0) {
        for (auto& item : elements(value)) scale_defaults(item, field, units);
    } else if constexpr (is_map<T>) {
        for (auto& item : value) scale_defaults(item.second, field, units);
    } else if constexpr (is_vector<T>) {
        for (auto& item : value) scale_defaults(item, field, units);
    } else if constexpr (is_variant<T>) {
        visit_held(value, [&](auto& record) { scale_defaults(record, {}, units); });
    } else if constexpr (is_optional<T>) {
        if (value) scale_defaults(*value, field, units);
    } else if constexpr (Record<T>) {
        scale_record(AnyRecord::of(value), units);
    }
}

/// A default value in the given units.
template <class T> T fresh(const Field& field, const Units& units) {
    T value{};
    scale_defaults(value, field, units);
    return value;
}

} // namespace sinew::detail

#pragma once

#include "sinew/math/point.h"
#include "sinew/math/record.h"
#include "sinew/math/vec.h"

#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

/// Types of a record's fields:
///
///     bool, integers, double, std::string     a value; a string may have `choices`
///     Point                                   as many numbers as the scene has dimensions
///     Vec<D, double>, std::array<T, N>        exactly D or N items
///     std::vector<T>                          any number of items
///     std::vector<std::pair<std::string, T>>  a map from names to values, in file order
///     std::optional<T>                        may be absent, with no default in its place
///     a Record                                an object
///     std::variant<Records...>                one of several records, see below
///     json::Value                             any JSON value, kept unchanged
///
/// The fields of a variant's alternative are members of the same object as the fields around the variant. Alternatives
/// are records with a `static constexpr std::string_view name`; the name of the variant field is the tag key, whose
/// value selects the alternative. With Field{.name = "prefab"}, this object holds the record called rope with its field
/// segments, beside a field of the enclosing record:
///
///     {"prefab": "rope", "name": "left", "segments": 20}
///
/// Without the tag key, the default applies: the first alternative, or none of an optional variant. With an empty field
/// name, the alternative is the one whose name is among the keys:
///
///     {"grab": "bob/right_hand", "duration": 30}
namespace sinew {

namespace detail {

template <class T> inline constexpr bool is_optional = false;
template <class T> inline constexpr bool is_optional<std::optional<T>> = true;

template <class T> inline constexpr bool is_vector = false;
template <class T> inline constexpr bool is_vector<std::vector<T>> = true;

template <class T> inline constexpr bool is_map = false;
template <class T> inline constexpr bool is_map<std::vector<std::pair<std::string, T>>> = true;

template <class T> inline constexpr bool is_variant = false;
template <class... T> inline constexpr bool is_variant<std::variant<T...>> = true;
template <class... T> inline constexpr bool is_variant<std::optional<std::variant<T...>>> = true;

/// Names of a variant's alternatives, in order.
template <class T> inline constexpr std::array<std::string_view, 0> alternative_names{};
template <class... R>
inline constexpr std::array<std::string_view, sizeof...(R)> alternative_names<std::variant<R...>> = {R::name...};
template <class... R>
inline constexpr std::array<std::string_view, sizeof...(R)> alternative_names<std::optional<std::variant<R...>>> = {
    R::name...};

/// Number of elements of a fixed-size array; 0 for other types.
template <class T> inline constexpr std::size_t array_size = 0;
template <class T, std::size_t N> inline constexpr std::size_t array_size<std::array<T, N>> = N;
template <int D, class T> inline constexpr std::size_t array_size<Vec<D, T>> = std::size_t(D);

template <class T, std::size_t N> std::array<T, N>& elements(std::array<T, N>& array) {
    return array;
}
template <class T, std::size_t N> const std::array<T, N>& elements(const std::array<T, N>& array) {
    return array;
}
template <int D, class T> auto& elements(Vec<D, T>& vec) {
    return vec.component;
}
template <int D, class T> const auto& elements(const Vec<D, T>& vec) {
    return vec.component;
}

template <class T>
concept Integer = std::integral<T> && !std::same_as<T, bool>;

/// Calls visit(std::type_identity<R>{}) for each alternative.
template <class Visit, class... R> void each_alternative(std::type_identity<std::variant<R...>>, Visit&& visit) {
    (visit(std::type_identity<R>{}), ...);
}
template <class Visit, class... R>
void each_alternative(std::type_identity<std::optional<std::variant<R...>>>, Visit&& visit) {
    (visit(std::type_identity<R>{}), ...);
}

/// Calls visit(record) with the alternative held, if any.
template <class Visit, class... R> void visit_held(std::variant<R...>& variant, Visit&& visit) {
    (void)((std::get_if<R>(&variant) ? (visit(*std::get_if<R>(&variant)), true) : false) || ...);
}
template <class Visit, class... R> void visit_held(const std::variant<R...>& variant, Visit&& visit) {
    (void)((std::get_if<R>(&variant) ? (visit(*std::get_if<R>(&variant)), true) : false) || ...);
}
template <class Variant, class Visit> void visit_held(std::optional<Variant>& variant, Visit&& visit) {
    if (variant) visit_held(*variant, visit);
}
template <class Variant, class Visit> void visit_held(const std::optional<Variant>& variant, Visit&& visit) {
    if (variant) visit_held(*variant, visit);
}

/// The field's description, applied to each element of a list.
constexpr Field element_of(Field field) {
    field.required = false;
    return field;
}

} // namespace detail

} // namespace sinew

#pragma once

#include "sinew/constraint/kinds.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

/// Constraint kinds at run time, for scene files, schemas, messages and panels.
namespace sinew {

struct KindInfo {
    std::string_view name;
    int min_arity = 0;      ///< least number of particles
    bool any_arity = false; ///< true if more than min_arity particles are allowed
    Dimensions dimensions;
    bool angle = false;   ///< true if the measure is an angle: radians in a world, degrees in a file
    int length_power = 0; ///< of the measure: 1 a length, 2 an area, 3 a volume, 0 an angle
    bool never_negative = false;
    DrawnAs drawn_as = DrawnAs::nothing;
    KindManual manual{};
};

namespace detail {

template <class Kind> constexpr int min_arity() {
    if constexpr (Kind::arity == any_arity)
        return Kind::min_arity;
    else
        return Kind::arity;
}

template <class... Kind> constexpr std::array<KindInfo, sizeof...(Kind)> infos_of(TypeList<Kind...>) {
    return {KindInfo{.name = Kind::name,
                     .min_arity = min_arity<Kind>(),
                     .any_arity = Kind::arity == any_arity,
                     .dimensions = Kind::dimensions,
                     .angle = Kind::length_power == 0,
                     .length_power = Kind::length_power,
                     .never_negative = is_never_negative<Kind>,
                     .drawn_as = is_drawn_as<Kind>,
                     .manual = manual_of<Kind>}...};
}

template <class... Kind> constexpr std::array<std::string_view, sizeof...(Kind)> names_of_kinds(TypeList<Kind...>) {
    return {Kind::name...};
}

} // namespace detail

/// All kinds, of every dimension.
inline constexpr auto every_kind = detail::infos_of(EveryKind<2>{});
inline constexpr auto kind_names = detail::names_of_kinds(EveryKind<2>{});

/// Kinds of D-dimensional worlds. The index is `ConstraintId::kind` and the index of the world's table.
template <int D> inline constexpr auto kinds_in = detail::infos_of(Kinds<D>{});

constexpr std::optional<KindInfo> kind_called(std::string_view name) {
    const auto found = std::find(kind_names.begin(), kind_names.end(), name);
    return found == kind_names.end() ? std::nullopt
                                     : std::optional(every_kind[std::size_t(found - kind_names.begin())]);
}

/// Index of a name in `kinds_in<D>`, or -1.
template <int D> constexpr int kind_index(std::string_view name) {
    for (std::size_t i = 0; i < kinds_in<D>.size(); ++i)
        if (kinds_in<D>[i].name == name) return int(i);
    return -1;
}

} // namespace sinew

#pragma once

#include "sinew/constraint/angle.h"
#include "sinew/constraint/area.h"
#include "sinew/constraint/dihedral.h"
#include "sinew/constraint/distance.h"
#include "sinew/constraint/pulley.h"
#include "sinew/constraint/rail.h"
#include "sinew/constraint/volume.h"

#include <type_traits>

namespace sinew {

template <class... Types> struct TypeList {
    static constexpr int size = sizeof...(Types);

    template <class Type>
    static constexpr int index_of = [] {
        int i = 0, found = -1;
        ((std::is_same_v<Type, Types> ? void(found = i++) : void(i++)), ...);
        return found;
    }();

    /// Calls visit with a value-less tag of each type, in order.
    template <class Visit> static constexpr void for_each(Visit&& visit) { (visit(std::type_identity<Types>{}), ...); }
};

/// The list of constraint kinds. A new kind is one new file, and here its header and one word.
template <int D> using EveryKind = TypeList<Distance<D>, Angle<D>, Area<D>, Volume<D>, Dihedral<D>, Pulley<D>, Rail<D>>;

namespace detail {

template <int D, class Chosen, class... Rest> struct InDimension { using type = Chosen; };

template <int D, class... Chosen, class Kind, class... Rest> struct InDimension<D, TypeList<Chosen...>, Kind, Rest...> {
    using type =
        typename std::conditional_t<Kind::dimensions.include(D), InDimension<D, TypeList<Chosen..., Kind>, Rest...>,
                                    InDimension<D, TypeList<Chosen...>, Rest...>>::type;
};

template <int D, class... Kind>
auto in_dimension(TypeList<Kind...>) -> typename InDimension<D, TypeList<>, Kind...>::type;

} // namespace detail

/// The kinds that exist in D dimensions, in the order of the list: a world has a table for each.
template <int D> using Kinds = decltype(detail::in_dimension<D>(EveryKind<D>{}));

/// Where a kind stands in the list of its dimension: kind_number<Distance, 2>.
template <template <int> class Kind, int D> inline constexpr int kind_number = Kinds<D>::template index_of<Kind<D>>;

} // namespace sinew

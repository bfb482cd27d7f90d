#pragma once

/// Types of world of a build: 2D and 3D, float and double. SINEW_WORLDS of the build lists those it has, and defines a
/// word for each that is left out (CMakeLists.txt).
///
///     SINEW_INSTANTIATE(X)    X(D, Real) for every type of world: explicit instantiations
///     SINEW_INSTANTIATE_2D(X) the same for those of two dimensions, and SINEW_INSTANTIATE_3D(X) for those of three
#ifdef SINEW_NO_WORLD_2_FLOAT
#define SINEW_WORLD_2_FLOAT(X)
#else
#define SINEW_WORLD_2_FLOAT(X) X(2, float)
#endif
#ifdef SINEW_NO_WORLD_2_DOUBLE
#define SINEW_WORLD_2_DOUBLE(X)
#else
#define SINEW_WORLD_2_DOUBLE(X) X(2, double)
#endif
#ifdef SINEW_NO_WORLD_3_FLOAT
#define SINEW_WORLD_3_FLOAT(X)
#else
#define SINEW_WORLD_3_FLOAT(X) X(3, float)
#endif
#ifdef SINEW_NO_WORLD_3_DOUBLE
#define SINEW_WORLD_3_DOUBLE(X)
#else
#define SINEW_WORLD_3_DOUBLE(X) X(3, double)
#endif

#define SINEW_INSTANTIATE_2D(X) SINEW_WORLD_2_FLOAT(X) SINEW_WORLD_2_DOUBLE(X)
#define SINEW_INSTANTIATE_3D(X) SINEW_WORLD_3_FLOAT(X) SINEW_WORLD_3_DOUBLE(X)
#define SINEW_INSTANTIATE(X) SINEW_INSTANTIATE_2D(X) SINEW_INSTANTIATE_3D(X)

namespace sinew {
namespace detail {
template <template <class...> class List, class, class... Entries> struct ListOf { using type = List<Entries...>; };
} // namespace detail

/// List<Of<2, float>, Of<2, double>, ...> over the types of world.
template <template <class...> class List, template <int, class> class Of>
#define SINEW_LIST_ENTRY(D, Real) , Of<D, Real>
using EveryWorld = typename detail::ListOf<List, void SINEW_INSTANTIATE(SINEW_LIST_ENTRY)>::type;
#undef SINEW_LIST_ENTRY

} // namespace sinew

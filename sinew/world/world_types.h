#pragma once

/// Types of world of a build: 2D and 3D, float and double. The build names SINEW_ONE_PRECISION if it has worlds of one
/// precision only.
namespace sinew {

#if defined(SINEW_ONE_PRECISION)

/// List<Of<2, Real>, Of<3, Real>> for every precision.
template <template <class...> class List, template <int, class> class Of>
using EveryWorld = List<Of<2, SINEW_ONE_PRECISION>, Of<3, SINEW_ONE_PRECISION>>;

/// Instantiates a template for every type of world: SINEW_INSTANTIATE(X) with X(D, Real).
#define SINEW_INSTANTIATE(X) SINEW_INSTANTIATE_2D(X) X(3, SINEW_ONE_PRECISION)
#define SINEW_INSTANTIATE_2D(X) X(2, SINEW_ONE_PRECISION)

#else

template <template <class...> class List, template <int, class> class Of>
using EveryWorld = List<Of<2, float>, Of<2, double>, Of<3, float>, Of<3, double>>;

#define SINEW_INSTANTIATE(X) SINEW_INSTANTIATE_2D(X) X(3, float) X(3, double)
#define SINEW_INSTANTIATE_2D(X) X(2, float) X(2, double)

#endif

} // namespace sinew

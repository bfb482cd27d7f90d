#include "sinew/world/world.h"

namespace sinew {

template <int D, class Real> World<D, Real>::World() = default;
template <int D, class Real> World<D, Real>::World(const World&) = default;
template <int D, class Real> World<D, Real>::World(World&&) noexcept = default;
template <int D, class Real> World<D, Real>& World<D, Real>::operator=(const World&) = default;
template <int D, class Real> World<D, Real>& World<D, Real>::operator=(World&&) noexcept = default;
template <int D, class Real> World<D, Real>::~World() = default;

#define SINEW_WORLD(D, Real) template struct World<D, Real>;
SINEW_INSTANTIATE(SINEW_WORLD)

} // namespace sinew

#include "sinew/prefab/wheel.h"

namespace sinew {

template <int D, class Real> void Wheel::build(Builder<D, Real>& figure) const {
    const auto hub = figure.ball("hub", {}, mass, radius, {.inertia = inertia, .spin = spin});
    figure.draw(Mark::dot, "tyre", {hub}, 2 * radius);
    figure.draw(Mark::dot, "disc", {hub}, 1.5 * radius);
    figure.draw(Mark::dot, "hub", {hub}, 0.3 * radius);
}

#define SINEW_WHEEL(D, Real) template void Wheel::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_WHEEL)

} // namespace sinew

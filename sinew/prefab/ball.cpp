#include "sinew/prefab/ball.h"

namespace sinew {

template <int D, class Real> void Ball::build(Builder<D, Real>& figure) const {
    const auto ball = figure.ball("ball", {}, mass, radius,
                                  {.inertia = hollow ? (D == 2 ? 1 : 2.0 / 3) : solid_inertia<D>, .spin = spin});
    figure.draw(Mark::dot, "ball", {ball}, 2 * radius);
}

#define SINEW_BALL(D, Real) template void Ball::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_BALL)

} // namespace sinew

#include "sinew/prefab/curtain.h"

namespace sinew {
namespace {

Cloth cloth_of(const Curtain& curtain) {
    return {.columns = curtain.columns,
            .rows = curtain.rows,
            .spacing = curtain.spacing,
            .pins = "list",
            .diagonals = "none",
            .mass = curtain.mass,
            .elasticity = curtain.elasticity,
            .strength = curtain.strength,
            .uneven = curtain.uneven,
            .drawn = curtain.drawn,
            .thickness = curtain.thickness};
}

} // namespace

Sizes Curtain::sizes() const {
    return cloth_of(*this).sizes();
}

template <int D, class Real> void Curtain::build(Builder<D, Real>& figure) const {
    auto cloth = cloth_of(*this);
    for (int column = 0; column + 1 < columns; ++column)
        if (column % hook_every == 0) cloth.pin_list.push_back(column);
    cloth.pin_list.push_back(columns - 1);
    cloth.build(figure);
    if (rod == 0) return;
    const std::vector ends{figure.named("top_left"), figure.named("top_right")};
    figure.draw(Mark::stroke, "rod", ends, rod);
    figure.draw(Mark::dot, "knob", ends, 1.8 * rod);
}

#define SINEW_CURTAIN(D, Real) template void Curtain::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_CURTAIN)

} // namespace sinew

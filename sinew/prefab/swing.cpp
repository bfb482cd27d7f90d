#include "sinew/prefab/swing.h"

namespace sinew {

Sizes Swing::sizes() const {
    const auto n = std::size_t(segments);
    return {.particles = 2 * n + 2, .constraints = 2 * n + 1};
}

template <int D, class Real> void Swing::build(Builder<D, Real>& figure) const {
    const double piece = length / segments;
    const auto rope = [&](double x, std::string_view stem, std::string_view hook, std::string_view end) {
        return build_strand(figure, {.pieces = segments,
                                     .length = length,
                                     .angle = angle,
                                     .mass = mass / 4,
                                     .weight = mass / 4 + weight / 2,
                                     .radius = thickness / 2,
                                     .x = x,
                                     .stem = stem,
                                     .first = hook,
                                     .last = end});
    };
    auto left = rope(-width / 2, "left", "left_hook", "seat_left");
    auto right = rope(width / 2, "right", "right_hook", "seat_right");
    const ConstraintSpec<double> spec{.limits = figure.mode() == Mode::classic ? exactly(piece) : at_most(piece)};
    link(figure, left, spec, "left_link");
    link(figure, right, spec, "right_link");
    figure.template constrain<Distance>("seat", {left.back(), right.back()}, {.limits = exactly(width)});
    hold_ends(figure, left, "start");
    hold_ends(figure, right, "start");

    const std::vector seat{left.back(), right.back()};
    figure.draw(Mark::curve, "rope", std::move(left), thickness);
    figure.draw(Mark::curve, "rope", std::move(right), thickness);
    figure.draw(Mark::stroke, "seat", seat, 2 * thickness);
}

#define SINEW_SWING(D, Real) template void Swing::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_SWING)

} // namespace sinew

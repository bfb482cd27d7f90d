#include "sinew/prefab/rope.h"

namespace sinew {

Sizes Rope::sizes() const {
    const auto n = std::size_t(segments);
    return {.particles = n + 1, .constraints = n + (bend_stiffness > 0 ? n - 1 : 0)};
}

std::optional<std::string> Rope::problem(int) const {
    if (slack > 0 && segments == 1) return "a rope of one segment cannot hang through: slack needs 2 segments or more";
    return std::nullopt;
}

template <int D, class Real> void Rope::build(Builder<D, Real>& figure) const {
    const double piece = length / segments;
    auto row = build_strand(figure, {.pieces = segments,
                                     .length = length,
                                     .angle = angle,
                                     .slack = slack,
                                     .mass = mass,
                                     .weight = weight,
                                     .radius = thickness / 2});
    // A piece that shortened would lose the direction that bends need: a stiff rope goes slack by bending alone.
    const bool is_stiff = bend_stiffness > 0 && figure.mode() == Mode::physical;
    const auto limits = links == "exact" || is_stiff ? exactly(piece) : at_most(piece);
    link(figure, row, strength.applied_to(elasticity.spec(limits)));
    if (bend_stiffness > 0 && segments > 1)
        stiffen(figure, row, Elasticity::of_rod(piece, bend_stiffness).spec(exactly(0.0)));
    hold_ends(figure, row, pinned);

    const auto end = row.back();
    figure.draw(Mark::curve, "rope", std::move(row), thickness);
    constexpr double weight_size = 4; // multiple of the rope's thickness
    if (weight > 0) figure.draw(Mark::dot, "weight", {end}, weight_size * thickness);
}

#define SINEW_ROPE(D, Real) template void Rope::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_ROPE)

} // namespace sinew

#include "sinew/prefab/box.h"

namespace sinew {

template <int D, class Real> void Box::build(Builder<D, Real>& figure) const {
    const auto corner = [&](std::string_view called, double x, double y) {
        return figure.particle(called, on_screen<D>(x * width / 2, y * height / 2), mass / 4, dot / 2);
    };
    const auto top_left = corner("top_left", -1, 1), top_right = corner("top_right", 1, 1);
    const auto bottom_right = corner("bottom_right", 1, -1), bottom_left = corner("bottom_left", -1, -1);

    const auto join = [&](std::string_view called, ParticleId a, ParticleId b) {
        figure.template constrain<Distance>(called, {a, b}, elasticity.spec());
    };
    const bool classic = figure.mode() == Mode::classic;
    if (classic) join("left", bottom_left, top_left); // left edge first, as in the Roblox article
    join("top", top_left, top_right);
    join("right", top_right, bottom_right);
    join("bottom", bottom_right, bottom_left);
    if (!classic) join("left", bottom_left, top_left);

    const std::vector corners{top_left, top_right, bottom_right, bottom_left};
    if (!classic) figure.draw(Mark::fill, "inside", corners); // the original draws lines only
    const auto brace = [&](std::string_view called, ParticleId a, ParticleId b) {
        join(called, a, b);
        figure.draw(Mark::stroke, "brace", {a, b}, thickness, true);
    };
    if (braces != "none") brace("diagonal", top_left, bottom_right);
    if (braces == "both") brace("other_diagonal", top_right, bottom_left);

    figure.draw(Mark::loop, "edge", corners, thickness);
    figure.draw(Mark::dot, "corner", corners, dot);
}

#define SINEW_BOX(D, Real) template void Box::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_BOX)

} // namespace sinew

#include "sinew/prefab/box.h"

#include <bit>

namespace sinew {

namespace {

/// Corner i of a cuboid is right, top and in front where the bits 0, 1 and 2 of i are set.
constexpr std::array<std::string_view, 8> corner_names = {"bottom_left_back", "bottom_right_back", "top_left_back",
                                                          "top_right_back",   "bottom_left_front", "bottom_right_front",
                                                          "top_left_front",   "top_right_front"};
constexpr std::array<std::array<std::size_t, 4>, 6> faces = {
    {{4, 5, 7, 6}, {0, 1, 3, 2}, {0, 4, 6, 2}, {1, 5, 7, 3}, {2, 6, 7, 3}, {0, 4, 5, 1}}};

/// Calls visit(i, k) for the corners i < k that differ in `bits` of the three directions; of the diagonals of a face,
/// one joins corners with an even number of bits and the other one those with an odd number.
template <class Visit> void each_pair(int bits, Visit&& visit) {
    for (unsigned i = 0; i < 8; ++i)
        for (unsigned k = i + 1; k < 8; ++k)
            if (std::popcount(i ^ k) == bits) visit(std::size_t(i), std::size_t(k), std::popcount(i) % 2 == 0);
}

/// Eight corners, twelve edges, and a diagonal across each face: as many rods as a body of eight points needs to be
/// rigid, and no more.
template <class Real> void build_cuboid(Builder<3, Real>& figure, const Box& box) {
    std::vector<ParticleId> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        const auto side = [&](std::size_t bit, double size) { return (i >> bit & 1) ? size / 2 : -size / 2; };
        corners.push_back(figure.particle(corner_names[i],
                                          {{side(0, box.width), side(1, box.height), side(2, box.depth)}}, box.mass / 8,
                                          box.dot / 2));
    }
    const auto join = [&](std::size_t i, std::size_t k) {
        figure.template constrain<Distance>("", {corners[i], corners[k]}, box.elasticity.spec());
    };
    const auto patch = [&](const std::array<std::size_t, 4>& face) {
        return std::vector{corners[face[0]], corners[face[1]], corners[face[2]], corners[face[3]]};
    };
    figure.number_constraints("edge", 12);
    each_pair(1, [&](std::size_t i, std::size_t k, bool) { join(i, k); });
    for (const auto& face : faces) figure.draw(Mark::fill, "inside", patch(face));
    if (box.braces != "none") {
        figure.number_constraints("brace", box.braces == "both" ? 12 : 6);
        for (const bool even : {true, false})
            each_pair(2, [&](std::size_t i, std::size_t k, bool is_even) {
                if (is_even != even || (!even && box.braces != "both")) return;
                join(i, k);
                figure.draw(Mark::stroke, "brace", {corners[i], corners[k]}, box.thickness, true);
            });
    }
    each_pair(1, [&](std::size_t i, std::size_t k, bool) {
        figure.draw(Mark::stroke, "edge", {corners[i], corners[k]}, box.thickness);
    });
    figure.draw(Mark::dot, "corner", corners, box.dot);
}

} // namespace

template <int D, class Real> void Box::build(Builder<D, Real>& figure) const {
    if constexpr (D == 3)
        build_cuboid(figure, *this);
    else
        build_square(figure);
}

template <class Real> void Box::build_square(Builder<2, Real>& figure) const {
    const auto corner = [&](std::string_view called, double x, double y) {
        return figure.particle(called, on_screen<2>(x * width / 2, y * height / 2), mass / 4, dot / 2);
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
SINEW_INSTANTIATE(SINEW_BOX)

} // namespace sinew

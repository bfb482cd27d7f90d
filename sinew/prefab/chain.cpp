#include "sinew/prefab/chain.h"

#include "sinew/math/format.h"

#include <cmath>

namespace sinew {
namespace {

/// Draws the original's chain: round loops, all seen from the broad side, and links between consecutive loops. The
/// first loop is the anchor.
template <int D, class Real>
void draw_loops(Builder<D, Real>& figure, const std::vector<ParticleId>& row, double loop) {
    constexpr double link = 0.25; // share of the loop's diameter
    for (std::size_t i = 0; i < row.size(); ++i)
        figure.draw(Mark::ring, i == 0 ? "anchor" : "loop", {row[i], row[i]}, loop);
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
        figure.draw(Mark::stroke, "link", {row[i], row[i + 1]}, link * loop);
}

/// Draws links alternately from the broad and the narrow side; the last link is seen from the broad side.
template <int D, class Real>
void draw_links(Builder<D, Real>& figure, const std::vector<ParticleId>& row, double thickness) {
    constexpr double narrow = 0.3; // thickness of the wire of a ring, as a share of the ring's
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
        const bool broad = (row.size() - i) % 2 == 0;
        figure.draw(broad ? Mark::ring : Mark::stroke, "link", {row[i], row[i + 1]},
                    broad ? thickness : narrow * thickness);
    }
}

} // namespace

Sizes Chain::sizes() const {
    const auto n = std::size_t(links);
    return {.particles = n + 1, .constraints = 2 * n - 1};
}

std::optional<std::string> Chain::problem(int) const {
    if (slack == 0) return std::nullopt;
    if (links == 1) return "a chain of one link cannot hang through: slack needs 2 links or more";
    const double turn = 2 * half_turn_of_slack(links, slack);
    if (turn <= bend_limit) return std::nullopt;
    constexpr double degrees = 180 / pi<double>;
    return format_text("with this slack the links turn by {} degrees, and bend_limit is {}: less slack, a higher "
                       "limit or more links",
                       std::round(turn * degrees), std::round(bend_limit * degrees));
}

template <int D, class Real> void Chain::build(Builder<D, Real>& figure) const {
    const bool classic = figure.mode() == Mode::classic;
    const double pitch = loop + gap;
    const auto row = build_strand(figure, {.pieces = links,
                                           .length = pitch * links,
                                           .angle = angle,
                                           .slack = slack,
                                           .mass = mass,
                                           .weight = weight,
                                           .radius = thickness / 2});
    // The original corrects the lower of two loops only.
    link(figure, row, strength.applied_to({.limits = exactly(pitch), .split = classic ? 0 : 0.5}));
    if (!classic && bend_limit < pi<double> && links > 1)
        stiffen(figure, row, {.limits = between(D == 2 ? -bend_limit : 0, bend_limit)}); // in 3D angles have no sign
    hold_ends(figure, row, pinned);
    classic ? draw_loops(figure, row, loop) : draw_links(figure, row, thickness);
}

#define SINEW_CHAIN(D, Real) template void Chain::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_CHAIN)

} // namespace sinew

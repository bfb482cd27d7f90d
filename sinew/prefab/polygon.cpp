#include "sinew/prefab/polygon.h"

#include "sinew/math/format.h"

namespace sinew {

Sizes Polygon::sizes() const {
    const auto n = std::size_t(sides);
    return {.particles = n + 1, .constraints = 2 * n};
}

std::optional<std::string> Polygon::problem(int) const {
    // A triangle has no diagonals and is rigid without.
    if (braced != "braces" || sides == 3 || brace_span <= sides - 2) return std::nullopt;
    return format_text("brace_span is {}: in a polygon of {} sides braces span 2 to {}", brace_span, sides, sides - 2);
}

template <int D, class Real> void Polygon::build(Builder<D, Real>& figure) const {
    const auto n = std::size_t(sides);
    const bool spoked = braced == "spokes";
    const double share = mass / double(spoked ? n + 1 : n);

    std::vector<ParticleId> corners;
    figure.number_particles("corner", n);
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = pi<double> * (double(2 * i + 1) / double(n) - 0.5);
        const auto position = on_screen<D>(radius * cosine(angle), radius * sine(angle));
        corners.push_back(figure.particle("", position, share, thickness / 2));
    }
    figure.number_constraints("edge", n);
    for (std::size_t i = 0; i < n; ++i)
        figure.template constrain<Distance>("", {corners[i], corners[(i + 1) % n]}, elasticity.spec());

    if (spoked) {
        const auto center = figure.particle("center", {}, share);
        figure.number_constraints("spoke", n);
        for (std::size_t i = 0; i < n; ++i)
            figure.template constrain<Distance>("", {center, corners[i]}, elasticity.spec());
    } else if (braced == "braces" && n > 3) {
        const auto span = std::size_t(brace_span);
        const auto braces = 2 * span == n ? span : n; // braces between opposite corners coincide in pairs
        figure.number_constraints("brace", braces);
        for (std::size_t i = 0; i < braces; ++i)
            figure.template constrain<Distance>("", {corners[i], corners[(i + span) % n]}, elasticity.spec());
    } else if (braced == "area") {
        figure.template constrain<Area>("area", corners);
    }

    figure.draw(Mark::fill, "inside", corners);
    figure.draw(Mark::loop, "edge", std::move(corners), thickness);
}

#define SINEW_POLYGON(D, Real) template void Polygon::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_POLYGON)

} // namespace sinew

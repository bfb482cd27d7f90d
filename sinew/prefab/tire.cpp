#include "sinew/prefab/tire.h"

namespace sinew {

template <int D, class Real> void Tire::build(Builder<D, Real>& figure) const {
    const auto n = std::size_t(segments);
    const bool classic = figure.mode() == Mode::classic;
    const double share = mass / double(n + 1);
    auto tread = tread_elasticity.spec(), spoke = spoke_elasticity.spec();
    if (classic) tread.relaxation = tread_relaxation, spoke.relaxation = spoke_relaxation;

    std::vector<ParticleId> corners;
    figure.number_particles("corner", n);
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * pi<double> * double(i) / double(n);
        corners.push_back(
            figure.particle("", on_screen<D>(radius * cosine(angle), radius * sine(angle)), share, thickness / 2));
    }
    const auto center = figure.particle("center", {}, share);

    figure.number_constraints("tread", n);
    for (std::size_t i = 0; i < n; ++i)
        figure.template constrain<Distance>("", {corners[i], corners[(i + 1) % n]}, tread);

    const auto span = std::size_t(brace_span) % n;
    if (span > 1 && span < n - 1) {
        const auto braces = 2 * span == n ? span : n; // braces between opposite corners coincide in pairs
        figure.number_constraints("brace", braces);
        for (std::size_t i = 0; i < braces; ++i) {
            figure.template constrain<Distance>("", {corners[i], corners[(i + span) % n]}, tread);
            figure.draw(Mark::stroke, "brace", {corners[i], corners[(i + span) % n]}, thickness / 8, true);
        }
    }
    figure.number_constraints("spoke", n);
    for (std::size_t i = 0; i < n; ++i) figure.template constrain<Distance>("", {center, corners[i]}, spoke);

    figure.draw(Mark::fill, "rim", corners);
    for (const auto corner : corners) figure.draw(Mark::stroke, "spoke", {center, corner}, thickness / 6);
    figure.draw(Mark::dot, "hub", {center}, 2 * thickness);
    figure.draw(Mark::loop, "tread", std::move(corners), thickness);
}

#define SINEW_TIRE(D, Real) template void Tire::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_TIRE)

} // namespace sinew

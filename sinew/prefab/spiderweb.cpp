#include "sinew/prefab/spiderweb.h"

namespace sinew {

template <int D, class Real> void Spiderweb::build(Builder<D, Real>& figure) const {
    const auto turn = std::size_t(spokes), n = turn * std::size_t(rings);
    const bool classic = figure.mode() == Mode::classic;

    std::vector<ParticleId> spiral;
    spiral.reserve(n);
    figure.number_particles("particle", n);
    for (std::size_t i = 0; i < n; ++i) {
        const double along = double(i) / double(n), angle = 2 * pi<double> * double(i) / double(turn);
        const double lean = angle + unevenness * (0.05 * cosine(0.4 * double(i)) + 0.2 * cosine(7 * along));
        const double out = radius * (1 - along) * (1 + unevenness * 0.05 * cosine(2 * angle / 3));
        const double sag = unevenness * 0.12 * radius * (1 - along) * cosine(2 * lean);
        const auto position = on_screen<D>(out * cosine(lean), out * sine(lean) + sag);
        spiral.push_back(figure.particle(i + 1 == n ? "center" : "", position, mass / double(n)));
    }

    std::vector<std::array<ParticleId, 2>> threads, across;
    for (std::size_t i = 0; i + 1 < n; ++i) threads.push_back({spiral[i], spiral[i + 1]});
    threads.push_back({spiral[turn - 1], spiral[0]}); // closes the rim
    for (std::size_t i = 0; i + 1 < n; ++i)
        if (const auto inner = min(i + turn, n - 1); inner != i + 1) across.push_back({spiral[i], spiral[inner]});
    const auto tie = [&](std::string_view called, const std::vector<std::array<ParticleId, 2>>& ties) {
        figure.number_constraints(called, ties.size());
        for (const auto& ends : ties) {
            const double length = rest * figure.template measure<Distance>(ends);
            figure.template constrain<Distance>("", ends, elasticity.spec(classic ? exactly(length) : at_most(length)));
            figure.draw(Mark::stroke, called, {ends[0], ends[1]}, thickness);
        }
    };
    tie("thread", threads);
    tie("spoke", across);

    for (std::size_t i = 0; anchor_every > 0 && i < turn; i += std::size_t(anchor_every)) {
        figure.hold(spiral[i]);
        figure.draw(Mark::dot, "anchor", {spiral[i]}, 6 * thickness, true);
    }
    figure.draw(Mark::dot, "dew", std::move(spiral), 4 * thickness, true);
}

#define SINEW_SPIDERWEB(D, Real) template void Spiderweb::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_SPIDERWEB)

} // namespace sinew

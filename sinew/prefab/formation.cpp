#include "sinew/prefab/formation.h"

namespace sinew {

Sizes Formation::sizes() const {
    const auto ships = std::size_t(columns) * std::size_t(rows);
    return {.particles = 2 * ships, .constraints = ships};
}

template <int D, class Real> void Formation::build(Builder<D, Real>& figure) const {
    const auto wide = std::size_t(columns), ships = wide * std::size_t(rows);
    const double each = mass / double(2 * ships), middle = 0.5 * double(wide - 1);
    const auto position = [&](std::size_t i) {
        return on_screen<D>(spacing * (double(i % wide) - middle), -spacing * double(i / wide));
    };
    std::vector<ParticleId> anchors, crew;
    figure.number_particles("anchor", ships, wide);
    for (std::size_t i = 0; i < ships; ++i) anchors.push_back(figure.particle("", position(i), each));
    figure.number_particles("ship", ships, wide);
    for (std::size_t i = 0; i < ships; ++i) crew.push_back(figure.particle("", position(i), each, size / 2));

    figure.number_constraints("spring", ships, wide);
    for (std::size_t i = 0; i < ships; ++i) {
        figure.hold(anchors[i]);
        figure.template constrain<Distance>("", {crew[i], anchors[i]}, elasticity.spec(exactly(0.0)));
    }
    for (std::size_t i = 0; i < ships; ++i) {
        figure.draw(Mark::stroke, "spring", {anchors[i], crew[i]}, 0.1 * size, true);
        figure.draw(Mark::dot, "ship", {crew[i]}, size);
    }
}

#define SINEW_FORMATION(D, Real) template void Formation::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_FORMATION)

} // namespace sinew

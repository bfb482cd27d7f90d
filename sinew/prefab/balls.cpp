#include "sinew/prefab/balls.h"

namespace sinew {

std::optional<std::string> Balls::problem(int dimension) const {
    if (dimension == 3 || layers == 1) return std::nullopt;
    return "layers lie behind each other: in 2 dimensions there is one";
}

template <int D, class Real> void Balls::build(Builder<D, Real>& figure) const {
    const double step = 2 * radius + gap;
    figure.number_particles("ball", sizes().particles);
    std::vector<ParticleId> all;
    for (int layer = 0; layer < layers; ++layer)
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                const double aside = row % 2 ? 0.25 : -0.25; // no ball stands on another
                auto position = on_screen<D>((column - 0.5 * (columns - 1) + aside) * step, row * step);
                if constexpr (D == 3) position[2] = (layer - 0.5 * (layers - 1) + aside) * step;
                all.push_back(figure.particle("", position, mass / double(sizes().particles), radius));
            }
    figure.draw(Mark::dot, "ball", std::move(all), 2 * radius);
}

#define SINEW_BALLS(D, Real) template void Balls::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_BALLS)

} // namespace sinew

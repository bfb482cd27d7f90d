#include "sinew/prefab/character.h"

namespace sinew {

std::optional<std::string> Character::problem(int) const {
    if (height < 2 * width) return "a character is at least twice as high as it is wide";
    if (step_height >= radius()) return "a step is lower than half of the character's width";
    return std::nullopt;
}

template <int D, class Real> void Character::build(Builder<D, Real>& figure) const {
    const auto feet = figure.particle("feet", on_screen<D>(0, radius()), mass / 2, radius());
    const auto head = figure.particle("head", on_screen<D>(0, height - radius()), mass / 2, radius());
    figure.template constrain<Distance>("spine", {feet, head});
    figure.draw(Mark::stroke, "body", {feet, head}, width);
    figure.draw(Mark::dot, "face", {head}, 0.6 * width);
}

#define SINEW_CHARACTER(D, Real) template void Character::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_CHARACTER)

} // namespace sinew

#include "sinew/prefab/crank.h"

namespace sinew {

std::optional<std::string> Crank::problem(int) const {
    if (!cylinder || rod > 1.01 * radius) return std::nullopt;
    return "with a cylinder the rod has to be longer than the radius, or it cannot come round";
}

template <int D, class Real> void Crank::build(Builder<D, Real>& figure) const {
    const auto along = on_screen<D>(cosine(angle), sine(angle));
    const auto on_rim = on_screen<D>(radius, 0);
    const double bore = 5 * thickness, skirt = 0.7 * bore; // width of the cylinder, length of the piston

    const auto hub = figure.particle("hub", {}, mass / (cylinder ? 12 : 4));
    const auto pin = figure.particle("pin", on_rim, mass / 4);
    figure.hold(hub);
    figure.template constrain<Distance>("arm", {hub, pin});
    if (!cylinder) {
        const auto end = figure.particle("end", on_rim + along * rod, mass / 2);
        figure.template constrain<Distance>("rod", {pin, end}, {.limits = exactly(rod)});
        draw(figure, hub, pin, end);
        return;
    }
    // End of the rod on the line through the hub, at distance s: s^2 - 2 s (pin . along) + radius^2 = rod^2.
    const double over = dot(on_rim, along);
    const double span = over + square_root(rod * rod - radius * radius + over * over);
    const auto end = figure.particle("end", along * span, mass / 4);
    const auto face = figure.particle("face", along * (span + skirt), mass / 4);
    const auto mouth = figure.particle("mouth", along * (rod - radius), mass / 12);
    const auto head = figure.particle("head", along * (rod + radius + 1.5 * skirt), mass / 12);
    figure.hold(mouth);
    figure.hold(head);
    figure.template constrain<Distance>("rod", {pin, end}, {.limits = exactly(rod)});
    figure.template constrain<Rail>("rail", {mouth, head, end}, {.limits = exactly(0.0)});
    figure.template constrain<Distance>("piston", {end, face}, {.limits = exactly(skirt)});
    figure.template constrain<Rail>("face_rail", {mouth, head, face}, {.limits = exactly(0.0)});
    figure.draw(Mark::stroke, "cylinder", {mouth, head}, bore);
    figure.draw(Mark::stroke, "piston", {end, face}, 0.8 * bore);
    draw(figure, hub, pin, end);
}

template <int D, class Real>
void Crank::draw(Builder<D, Real>& figure, ParticleId hub, ParticleId pin, ParticleId end) const {
    figure.draw(Mark::dot, "wheel", {hub}, 2 * radius + 3 * thickness);
    figure.draw(Mark::stroke, "arm", {hub, pin}, 2 * thickness);
    figure.draw(Mark::dot, "hub", {hub}, 1.5 * thickness);
    figure.draw(Mark::stroke, "rod", {pin, end}, thickness);
    figure.draw(Mark::dot, "joint", {pin, end}, 0.7 * thickness);
}

#define SINEW_CRANK(D, Real) template void Crank::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_CRANK)

} // namespace sinew

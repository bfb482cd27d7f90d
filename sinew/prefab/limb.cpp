#include "sinew/prefab/limb.h"

#include "sinew/math/format.h"

namespace sinew {

std::optional<std::string> Limb::problem(int) const {
    if (bend_min <= bend && bend <= bend_max) return std::nullopt;
    const auto degrees = [](double radians) { return radians * 180 / pi<double>; };
    return format_text("bend is {:6} degrees, out of its limits {:6} and {:6}", degrees(bend), degrees(bend_min),
                       degrees(bend_max));
}

template <int D, class Real> void Limb::build(Builder<D, Real>& figure) const {
    const auto along = [](double heading, double length) {
        return on_screen<D>(sine(heading) * length, -cosine(heading) * length);
    };
    const auto elbow = along(angle, upper);
    // The mass of a bone is proportional to its length, and half of it goes to either end.
    const double heavy = mass * upper / (upper + lower) / 2, light = mass / 2 - heavy;
    const auto root = figure.particle("root", {}, heavy, width / 2);
    const auto joint = figure.particle("joint", elbow, mass / 2, (width + end_width) / 4);
    const auto end = figure.particle("end", elbow + along(angle + bend, lower), light, end_width / 2);

    figure.template constrain<Distance>("upper", {root, joint});
    figure.template constrain<Distance>("lower", {joint, end});
    const auto range = D == 2 ? between(bend_min, bend_max) : between(0.0, max(-bend_min, bend_max));
    if (figure.mode() == Mode::physical)
        figure.template constrain<Angle>("bend", {root, joint, end}, {.limits = range});
    if (pinned) figure.hold(root);

    if (tip > 0) figure.draw(Mark::tip, "tip", {root, joint, end}, tip);
    figure.draw_tapered(Mark::limb, "limb", {root, joint, end}, width, end_width);
}

#define SINEW_LIMB(D, Real) template void Limb::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE(SINEW_LIMB)

} // namespace sinew

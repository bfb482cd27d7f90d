#include "sinew/prefab/car.h"

#include "sinew/prefab/steer.h"

#include <array>

namespace sinew {
namespace {

struct BodyPoint {
    std::string_view name;
    double x, y; ///< x in lengths of the car from its middle, y in radii of a wheel from the ground
};

/// Outline of the body, from the axle at the rear counter-clockwise.
constexpr std::array<BodyPoint, 6> outline{{{"rear", -0.34, 1.5},
                                            {"front", 0.34, 1.5},
                                            {"nose", 0.5, 2.1},
                                            {"roof_front", 0.1, 3.9},
                                            {"roof_back", -0.3, 3.9},
                                            {"tail", -0.5, 2.5}}};

constexpr double body_round = 0.12; // radius of the corners of the body, in radii of a wheel

} // namespace

std::optional<std::string> Car::problem(int) const {
    if (length < 5 * wheel_radius) return "a car is at least five times as long as the radius of a wheel";
    return std::nullopt;
}

template <int D, class Real> void Car::build(Builder<D, Real>& figure) const {
    figure.figure().direct = Direct::off; // a block does not turn wheels
    const double r = wheel_radius, part = mass * (1 - wheel_share) / double(outline.size());
    const auto wheel = [&](std::string_view called, double x) {
        return figure.ball(called, on_screen<D>(x * length, r), mass * wheel_share / 2, r,
                           {.inertia = car_wheel_inertia});
    };
    const auto back = wheel("rear_wheel", outline[0].x), ahead = wheel("front_wheel", outline[1].x);
    std::vector<ParticleId> body;
    for (const auto& point : outline)
        body.push_back(figure.particle(point.name, on_screen<D>(point.x * length, point.y * r), part, body_round * r));

    const ConstraintSpec<double> spring{.compliance = 1 / stiffness, .damping_time = damping_time};
    figure.template constrain<Distance>("rear_arm", {back, body[1]});
    figure.template constrain<Distance>("rear_spring", {back, body[0]}, spring);
    figure.template constrain<Distance>("front_arm", {ahead, body[0]});
    figure.template constrain<Distance>("front_spring", {ahead, body[1]}, spring);
    figure.number_constraints("frame", body.size() * (body.size() - 1) / 2);
    for (std::size_t i = 0; i < body.size(); ++i)
        for (std::size_t k = i + 1; k < body.size(); ++k) figure.template constrain<Distance>("", {body[i], body[k]});

    figure.draw(Mark::fill, "cabin", {body[2], body[3], body[4], body[5]});
    figure.draw(Mark::fill, "body", {body[0], body[1], body[2], body[5]});
    figure.draw(Mark::loop, "outline", body, 2 * body_round * r);
    for (const auto hub : {back, ahead}) {
        figure.draw(Mark::dot, "tyre", {hub}, 2 * r);
        figure.draw(Mark::dot, "disc", {hub}, 1.3 * r);
        figure.draw(Mark::dot, "hub", {hub}, 0.3 * r);
    }
}

#define SINEW_CAR(D, Real) template void Car::build(Builder<D, Real>&) const;
SINEW_INSTANTIATE_2D(SINEW_CAR)

} // namespace sinew

#pragma once

#include "sinew/prefab/builder.h"

#include <optional>
#include <string>

namespace sinew {

/// A car seen from its left side, front to the right, that stands on its own position. Particles rear_wheel and
/// front_wheel, hubs that roll; rear, front, nose, roof_front, roof_back and tail, the body. Constraints rear_arm and
/// front_arm hold a hub at its distance from the far end of the body, rear_spring and front_spring carry the near end;
/// frame_0, ... join the body. steer() (steer.h) drives it.
struct Car {
    static constexpr std::string_view name = "car";
    static constexpr std::string_view about =
        "A car on two sprung wheels, with a motor on each axle, brakes, and a body that leans in the air.";
    static constexpr Dimensions dimensions{2, 2};

    double length = 2.4;
    double wheel_radius = 0.36;
    double mass = 80;
    double wheel_share = 0.15;
    double stiffness = 12000;
    double damping_time = 0.08;
    double torque = 120;
    double top_speed = 12;
    double brake = 300;
    double lean = 150;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6;
        constexpr Unit torque_unit{.length = 2, .mass = 1, .time = -2};
        visit(self.length, Field{.name = "length",
                                 .help = "Length from tail to nose; at least five times the radius of a wheel",
                                 .unit = unit::length,
                                 .low = min,
                                 .high = max});
        visit(
            self.wheel_radius,
            Field{.name = "wheel_radius", .help = "Radius of a wheel", .unit = unit::length, .low = min, .high = max});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.wheel_share,
              Field{.name = "wheel_share", .help = "Share of the mass in both wheels", .low = 0.01, .high = 0.9});
        visit(self.stiffness, Field{.name = "stiffness",
                                    .help = "Stiffness of the spring of each axle",
                                    .unit = {.mass = 1, .time = -2},
                                    .low = 1e-6,
                                    .high = 1e12});
        visit(self.damping_time, Field{.name = "damping_time",
                                       .help = "Damping of the springs, as their damping_time",
                                       .unit = unit::time,
                                       .low = 0,
                                       .high = 10});
        visit(self.torque, Field{.name = "torque",
                                 .help = "Largest torque of the motor of each axle",
                                 .unit = torque_unit,
                                 .low = 0,
                                 .high = 1e12});
        visit(self.top_speed, Field{.name = "top_speed",
                                    .help = "Speed to which the motors turn the wheels",
                                    .unit = unit::speed,
                                    .low = 0,
                                    .high = max});
        visit(self.brake, Field{.name = "brake",
                                .help = "Largest torque of the brake of each axle",
                                .unit = torque_unit,
                                .low = 0,
                                .high = 1e12});
        visit(self.lean, Field{.name = "lean",
                               .help = "Torque by which the body leans where no wheel stands on anything",
                               .unit = torque_unit,
                               .low = 0,
                               .high = 1e12});
    }

    Sizes sizes() const { return {.particles = 8, .constraints = 19}; }
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

#pragma once

#include "sinew/prefab/builder.h"

#include <optional>
#include <string>

namespace sinew {

/// A capsule that stands on its own position. Particles feet and head, the middles of its two ends; constraint spine.
/// walk() (walk.h) moves it.
struct Character {
    static constexpr std::string_view name = "character";
    static constexpr std::string_view about = "A character of a platform game: a capsule that walks, climbs steps, "
                                              "jumps, rides platforms, and hangs on ropes "
                                              "and planks.";
    static constexpr Dimensions dimensions{2, 2};

    double height = 1.7;
    double width = 0.5;
    double mass = 70;
    double speed = 4;
    double acceleration = 40;
    double air_acceleration = 12;
    double jump_height = 1.2;
    double max_slope = 50 * pi<double> / 180;
    double step_height = 0.2;
    double reach = 0.6;
    double climb_speed = 1.5;
    double swing = 3;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6, degree = pi<double> / 180;
        visit(self.height, Field{.name = "height",
                                 .help = "Height; at least twice the width",
                                 .unit = unit::length,
                                 .low = min,
                                 .high = max});
        visit(self.width, Field{.name = "width", .help = "Width", .unit = unit::length, .low = min, .high = max});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.speed, Field{.name = "speed",
                                .help = "Speed on the ground, relative to it",
                                .unit = unit::speed,
                                .low = 0,
                                .high = max});
        visit(self.acceleration, Field{.name = "acceleration",
                                       .help = "Largest acceleration on the ground",
                                       .unit = unit::acceleration,
                                       .low = 0,
                                       .high = 1e9});
        visit(self.air_acceleration, Field{.name = "air_acceleration",
                                           .help = "Largest acceleration to the sides in the air",
                                           .unit = unit::acceleration,
                                           .low = 0,
                                           .high = 1e9});
        visit(self.jump_height, Field{.name = "jump_height",
                                      .help = "Height of a jump from the ground",
                                      .unit = unit::length,
                                      .low = 0,
                                      .high = max});
        visit(self.max_slope, Field{.name = "max_slope",
                                    .help = "Steepest slope that it can stand on",
                                    .unit = unit::angle,
                                    .low = 0,
                                    .high = 89 * degree});
        visit(self.step_height, Field{.name = "step_height",
                                      .help = "Highest step that it walks up, below half of the width; also the depth "
                                              "of dents and the drop of slopes that it follows",
                                      .unit = unit::length,
                                      .low = 0,
                                      .high = max});
        visit(self.reach, Field{.name = "reach",
                                .help = "Distance from the middle of its head at which it takes hold; half of it is "
                                        "the length of its arms",
                                .unit = unit::length,
                                .low = min,
                                .high = max});
        visit(self.climb_speed, Field{.name = "climb_speed",
                                      .help = "Speed along a rope or a ladder",
                                      .unit = unit::speed,
                                      .low = 0,
                                      .high = max});
        visit(self.swing, Field{.name = "swing",
                                .help = "Acceleration to the sides while it hangs: it swings a rope up",
                                .unit = unit::acceleration,
                                .low = 0,
                                .high = 1e9});
    }

    double radius() const { return width / 2; }
    Sizes sizes() const { return {.particles = 2, .constraints = 1}; }
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

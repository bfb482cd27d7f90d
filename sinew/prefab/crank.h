#pragma once

#include "sinew/prefab/builder.h"

#include <optional>
#include <string>

namespace sinew {

/// A wheel, positioned by its hub, with a rod at a pin on the rim; the pin starts on the right. Particles hub (held),
/// pin and end (of the rod); constraints arm (hub to pin) and rod. A scene turns the wheel by a pin on "crank/pin" with
/// an orbit driver about the hub. With a cylinder the end is a piston on a line through the hub: also particles face
/// (of the piston), mouth and head (of the cylinder, held); constraints rail, piston and face_rail.
struct Crank {
    static constexpr std::string_view name = "crank";
    static constexpr std::string_view about = "A wheel with a rod at its rim, and optionally a piston.";
    static constexpr Dimensions dimensions{2, 2};

    double radius = 0.5;
    double rod = 1.5;
    double angle = 0;
    bool cylinder = true;
    double mass = 6;
    double thickness = 0.08;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6;
        visit(self.radius, Field{.name = "radius",
                                 .help = "Distance from the hub to the pin on the rim",
                                 .unit = unit::length,
                                 .low = min,
                                 .high = max});
        visit(self.rod,
              Field{.name = "rod", .help = "Length of the rod", .unit = unit::length, .low = min, .high = max});
        visit(self.angle, Field{.name = "angle",
                                .help = "Initial direction of the rod: 0 to the right, 90 upwards",
                                .unit = unit::angle,
                                .low = -2 * pi<double>,
                                .high = 2 * pi<double>});
        visit(self.cylinder, Field{.name = "cylinder", .help = "A piston in a cylinder at the end of the rod"});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of the rod as drawn",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = max});
    }

    Sizes sizes() const { return {.particles = 6, .constraints = 5}; }
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;

  private:
    template <int D, class Real>
    void draw(Builder<D, Real>& figure, ParticleId hub, ParticleId pin, ParticleId end) const;
};

} // namespace sinew

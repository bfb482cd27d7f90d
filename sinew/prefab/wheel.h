#pragma once

#include "sinew/prefab/builder.h"

namespace sinew {

/// A wheel on its hub, a particle `hub` to which links and other figures hold without hindering its turn. In 3D the
/// wheel touches as a ball does.
struct Wheel {
    static constexpr std::string_view name = "wheel";
    static constexpr std::string_view about =
        "A wheel that rolls, most of its mass in its rim; its hub, a particle, is "
        "its axle.";
    static constexpr Dimensions dimensions{2, 3};

    double radius = 0.3;
    double mass = 5;
    double inertia = 0.8;
    double spin = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.radius, Field{.name = "radius", .help = "Radius", .unit = unit::length, .low = 1e-6, .high = 1e6});
        visit(self.mass, Field{.name = "mass", .help = "Mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.inertia, Field{.name = "inertia",
                                  .help = "Moment of inertia, as a share of mass times radius^2: 0.5 a disc, 1 a hoop",
                                  .low = 0.001,
                                  .high = 1});
        visit(self.spin, Field{.name = "spin",
                               .help = "Angular velocity at first, counter-clockwise on screen; in 3D about z",
                               .unit = unit::spin,
                               .low = -1e6,
                               .high = 1e6});
    }

    Sizes sizes() const { return {.particles = 1}; }
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

#pragma once

#include "sinew/prefab/builder.h"

namespace sinew {

/// A particle `ball` that rolls: a disc in 2D, a ball in 3D, positioned by its centre.
struct Ball {
    static constexpr std::string_view name = "ball";
    static constexpr std::string_view about = "A ball that rolls; in 2D a disc.";
    static constexpr Dimensions dimensions{2, 3};

    double radius = 0.1;
    double mass = 1;
    bool hollow = false;
    double spin = 0;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.radius, Field{.name = "radius", .help = "Radius", .unit = unit::length, .low = 1e-6, .high = 1e6});
        visit(self.mass, Field{.name = "mass", .help = "Mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.hollow, Field{.name = "hollow", .help = "All mass at the surface: a hoop, a hollow ball"});
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

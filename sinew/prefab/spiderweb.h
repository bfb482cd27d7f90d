#pragma once

#include "sinew/prefab/builder.h"
#include "sinew/prefab/material.h"

namespace sinew {

/// A web around the figure's position: one thread in a spiral from the rim inwards, each particle also linked to the
/// one a turn further in. Particles particle_0, ..., the last also called center; constraints thread_0, ... along the
/// spiral, the last closing the rim, and spoke_0, ... across. (After the web of verlet-js, made a little uneven.)
struct Spiderweb {
    static constexpr std::string_view name = "spiderweb";
    static constexpr std::string_view about = "A web stretched between a few anchors.";
    static constexpr Dimensions dimensions{2, 3};

    double radius = 1.5;
    int spokes = 20;
    int rings = 7;
    int anchor_every = 4;
    double rest = 0.3;
    double unevenness = 1;
    Elasticity elasticity{1 /* m/N */};
    double mass = 0.1;
    double thickness = 0.01;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.radius, Field{.name = "radius",
                                 .help = "Distance from the centre (the figure's position) to the rim",
                                 .unit = unit::length,
                                 .low = 1e-6,
                                 .high = 1e6});
        visit(self.spokes, Field{.name = "spokes", .help = "Particles in a turn", .low = 3, .high = 1e5});
        visit(self.rings, Field{.name = "rings", .help = "Turns of the spiral", .low = 2, .high = 1e4});
        visit(self.anchor_every, Field{.name = "anchor_every",
                                       .help = "Spacing of the anchors: every n-th particle of the rim is held, "
                                               "beginning with the first; 0 for none",
                                       .low = 0,
                                       .high = 1e5});
        visit(self.rest, Field{.name = "rest",
                               .help = "Rest length of the threads, as a share of the initial length",
                               .low = 0.01,
                               .high = 1});
        visit(self.unevenness, Field{.name = "unevenness",
                                     .help = "Irregularity: 0 for a perfect spiral, 1 for a natural one",
                                     .low = 0,
                                     .high = 1});
        Elasticity::fields(self.elasticity, visit, "Compliance of a thread", 1e-9);
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of a thread as drawn",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
    }

    Sizes sizes() const {
        const auto n = std::size_t(spokes) * std::size_t(rings);
        return {.particles = n, .constraints = 2 * n};
    }
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

#pragma once

#include "sinew/prefab/cloth.h"

namespace sinew {

/// A cloth on a rod, positioned by the middle of the rod; names of particles and constraints as in Cloth. Threads run
/// across and down only, so tears follow the threads. The defaults are the curtain of the tearable cloth tutorial.
struct Curtain {
    static constexpr std::string_view name = "curtain";
    static constexpr std::string_view about = "A curtain on a rod, to be pulled aside, torn and cut.";
    static constexpr Dimensions dimensions{2, 3};

    int columns = 61;
    int rows = 41;
    double spacing = 0.06;
    int hook_every = 1;
    double mass = 2;
    Elasticity elasticity{2e-4 /* m/N */};
    Strength strength{.breaking_strain = 0.3, .damage_limit = 0.01};
    double uneven = 0.8;
    std::string drawn = "fill";
    double thickness = 0.01;
    double rod = 0.1;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6;
        visit(self.columns, Field{.name = "columns", .help = "Particles from left to right", .low = 2, .high = 1e9});
        visit(self.rows, Field{.name = "rows", .help = "Particles from top to bottom", .low = 2, .high = 1e9});
        visit(self.spacing, Field{.name = "spacing",
                                  .help = "Distance between neighbouring particles",
                                  .unit = unit::length,
                                  .low = min,
                                  .high = max});
        visit(self.hook_every,
              Field{.name = "hook_every",
                    .help = "Spacing of the hooks: every n-th particle of the top row, and both ends, hang on the rod",
                    .low = 1,
                    .high = 1e9});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        Elasticity::fields(self.elasticity, visit, "Compliance of a thread; 0 is inextensible");
        Strength::fields(self.strength, visit, "Strain at which a thread tears; 0 for never");
        visit(
            self.uneven,
            Field{.name = "uneven",
                  .help =
                      "Random extra strength of each thread, as a share of breaking_strain: 1 is up to twice as strong",
                  .low = 0,
                  .high = 1e3});
        visit(self.drawn,
              Field{.name = "drawn", .help = "Drawn as threads, as filled cells, or both", .choices = Cloth::drawings});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of a drawn thread; collision radius is half",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = max});
        visit(self.rod, Field{.name = "rod",
                              .help = "Thickness of the rod as drawn; 0 for no rod",
                              .unit = unit::length,
                              .low = 0,
                              .high = max});
    }

    Sizes sizes() const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

#pragma once

#include "sinew/prefab/builder.h"
#include "sinew/prefab/material.h"

namespace sinew {

/// Ships in rows and columns, each on a spring to an anchor of its own, positioned by the middle of the top row.
/// Particles anchor_0_0 (held, top left), anchor_1_0 to the right, anchor_0_1 below, ...; ship_0_0, ...; constraints
/// spring_0_0, .... A scene moves the formation by a pin on "formation/anchor_*" with a driver. Classic mode needs a
/// relaxation, and a split of 1, so that corrections move the ships and not the anchors.
struct Formation {
    static constexpr std::string_view name = "formation";
    static constexpr std::string_view about = "Ships in rows, held by springs to anchors that can move.";
    static constexpr Dimensions dimensions{2, 3};

    int columns = 8;
    int rows = 4;
    double spacing = 0.6;
    double size = 0.4;
    double mass = 32;
    Elasticity elasticity{0.01 /* m/N */};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.columns, Field{.name = "columns", .help = "Ships from left to right", .low = 1, .high = 1e9});
        visit(self.rows, Field{.name = "rows", .help = "Ships from top to bottom", .low = 1, .high = 1e9});
        visit(self.spacing, Field{.name = "spacing",
                                  .help = "Distance between neighbouring ships",
                                  .unit = unit::length,
                                  .low = 1e-6,
                                  .high = 1e6});
        visit(self.size, Field{.name = "size",
                               .help = "Diameter of a ship as drawn; collision radius is half",
                               .unit = unit::length,
                               .low = 1e-6,
                               .high = 1e6});
        visit(self.mass, Field{.name = "mass",
                               .help = "Total mass, in equal parts for every ship and anchor",
                               .unit = unit::mass,
                               .low = 1e-6,
                               .high = 1e9});
        Elasticity::fields(self.elasticity, visit, "Compliance of a spring");
    }

    Sizes sizes() const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

#pragma once

#include "sinew/prefab/material.h"
#include "sinew/prefab/strand.h"

#include <optional>
#include <string>

namespace sinew {

/// A rope hanging from the figure's position. Particles particle_0 (also called start), ..., the last also called end;
/// constraints link_0 (particle_0 to particle_1), ..., and with bend_stiffness bend_0 (at particle_1), ....
struct Rope {
    static constexpr std::string_view name = "rope";
    static constexpr std::string_view about =
        "A rope that hangs, swings, goes slack and can carry a weight at its end.";
    static constexpr Dimensions dimensions{2, 3};
    static constexpr std::array<std::string_view, 2> link_rules{"at_most", "exact"};

    double length = 2;
    int segments = 20;
    double angle = 0; ///< radians
    double slack = 0;
    std::string pinned = "start";
    double mass = 1;
    double weight = 0;
    std::string links = "at_most";
    Elasticity elasticity{};
    double bend_stiffness = 0;
    Strength strength{};
    double thickness = 0.03;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6, lightest = 1e-6, heaviest = 1e9;
        visit(self.length,
              Field{.name = "length", .help = "Length along the rope", .unit = unit::length, .low = min, .high = max});
        visit(self.segments, Field{.name = "segments", .help = "Number of straight pieces", .low = 1, .high = 1e9});
        visit(self.angle,
              Field{.name = "angle",
                    .help = "Initial direction: 0 hangs straight down, a quarter turn is level to the right",
                    .unit = unit::angle,
                    .low = -4 * pi<double>,
                    .high = 4 * pi<double>});
        visit(self.slack, Field{.name = "slack",
                                .help = "Excess of the length over the distance between the ends: 0.1 is 10 %",
                                .low = 0,
                                .high = 100});
        visit(self.pinned, Field{.name = "pinned", .help = "Ends held in place", .choices = strand_ends});
        visit(self.mass, Field{.name = "mass",
                               .help = "Mass of the rope, without the weight",
                               .unit = unit::mass,
                               .low = lightest,
                               .high = heaviest});
        visit(self.weight, Field{.name = "weight",
                                 .help = "Additional mass at the end",
                                 .unit = unit::mass,
                                 .low = 0,
                                 .high = heaviest});
        visit(self.links, Field{.name = "links",
                                .help = "Type of the links. at_most: can go slack; exact: can also push, like a rod, "
                                        "as links of a physical rope with bend_stiffness always do",
                                .choices = link_rules});
        Elasticity::fields(self.elasticity, visit, "Compliance of a piece; 0 is inextensible");
        visit(self.bend_stiffness, Field{.name = "bend_stiffness",
                                         .help = "Resistance to bending (E I of a rod); 0 is a limp rope",
                                         .unit = {.length = 3, .mass = 1, .time = -2},
                                         .low = 0,
                                         .high = 1e12});
        Strength::fields(self.strength, visit, "Strain at which a piece tears; 0 for never");
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness as drawn; collision radius is half",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = max});
    }

    Sizes sizes() const;
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

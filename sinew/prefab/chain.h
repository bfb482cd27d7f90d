#pragma once

#include "sinew/prefab/material.h"
#include "sinew/prefab/strand.h"

#include <optional>
#include <string>

namespace sinew {

/// A chain of stiff links between consecutive particles, hanging from the figure's position. Particles particle_0 (also
/// called start), ..., the last also called end; constraints link_0, ..., and with bend_limit bend_0 (at particle_1),
/// ....
struct Chain {
    static constexpr std::string_view name = "chain";
    static constexpr std::string_view about = "A chain of stiff links.";
    static constexpr Dimensions dimensions{2, 3};

    int links = 20;
    double loop = 0.24;
    double gap = 0.02;
    double angle = 0; ///< radians
    double slack = 0;
    std::string pinned = "start";
    double mass = 3;
    double weight = 0;
    double bend_limit = pi<double>;
    Strength strength{};
    double thickness = 0.06;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6, lightest = 1e-6, heaviest = 1e9;
        visit(self.links, Field{.name = "links", .help = "Number of links", .low = 1, .high = 1e9});
        visit(
            self.loop,
            Field{.name = "loop", .help = "Length of a link as drawn", .unit = unit::length, .low = min, .high = max});
        visit(self.gap, Field{.name = "gap",
                              .help = "Gap between consecutive drawn links",
                              .unit = unit::length,
                              .low = 0,
                              .high = max});
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
                               .help = "Mass of the chain, without the weight",
                               .unit = unit::mass,
                               .low = lightest,
                               .high = heaviest});
        visit(self.weight, Field{.name = "weight",
                                 .help = "Additional mass at the end",
                                 .unit = unit::mass,
                                 .low = 0,
                                 .high = heaviest});
        visit(self.bend_limit,
              Field{.name = "bend_limit",
                    .help = "Largest angle between consecutive links; 180 for no limit. Physical mode only",
                    .unit = unit::angle,
                    .low = pi<double> / 180,
                    .high = pi<double>});
        Strength::fields(self.strength, visit, "Strain at which a link tears; 0 for never");
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Width of a link seen from its broad side; collision radius is half",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = max});
    }

    Sizes sizes() const;
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

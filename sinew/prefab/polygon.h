#pragma once

#include "sinew/prefab/builder.h"
#include "sinew/prefab/material.h"

#include <array>
#include <optional>
#include <string>

namespace sinew {

/// A regular polygon that rests on one of its sides, positioned by its centre. Particles corner_0 (the right end of the
/// lowest side), corner_1, ... counter-clockwise, and `center` if there are spokes; constraints edge_0 (corner_0 to
/// corner_1), ..., then spoke_0, ... or brace_0, ... or `area`.
struct Polygon {
    static constexpr std::string_view name = "polygon";
    static constexpr std::string_view about = "A regular polygon: three sides make a triangle, many a wheel.";
    static constexpr Dimensions dimensions{2, 2};
    static constexpr std::array<std::string_view, 4> bracings{"none", "spokes", "braces", "area"};

    int sides = 6;
    double radius = 0.5;
    std::string braced = "braces";
    int brace_span = 2;
    Elasticity elasticity{};
    double mass = 1;
    double thickness = 0.04;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.sides, Field{.name = "sides", .help = "Number of sides", .low = 3, .high = 1e9});
        visit(self.radius, Field{.name = "radius",
                                 .help = "Distance from the centre (the figure's position) to a corner",
                                 .unit = unit::length,
                                 .low = 1e-6,
                                 .high = 1e6});
        visit(self.braced, Field{.name = "braced",
                                 .help = "Support of the shape: spokes to a centre, braces between corners, constant "
                                         "area (jelly, if the edges are soft) or none",
                                 .choices = bracings});
        visit(self.brace_span,
              Field{.name = "brace_span", .help = "Number of sides spanned by a brace", .low = 2, .high = 1e9});
        Elasticity::fields(self.elasticity, visit, "Compliance of edges, spokes and braces; 0 is rigid");
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of the outline; collision radius of the corners is half",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
    }

    Sizes sizes() const;
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

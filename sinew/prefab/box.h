#pragma once

#include "sinew/prefab/builder.h"
#include "sinew/prefab/material.h"

#include <array>
#include <optional>
#include <string>

namespace sinew {

/// Four corners around the figure's position: particles top_left, top_right, bottom_right, bottom_left. Constraints
/// top, right, bottom, left (in classic mode left comes first), then diagonal (top left to bottom right) and
/// other_diagonal. In 3D eight corners, top_left_front to bottom_right_back with the front towards the viewer;
/// constraints edge_0 to edge_11 and brace_0, ..., one or two across each face.
struct Box {
    static constexpr std::string_view name = "box";
    static constexpr std::string_view about = "A crate: corners, edges, and one or two braces across each face.";
    static constexpr Dimensions dimensions{2, 3};
    static constexpr std::array<std::string_view, 3> bracings{"one", "both", "none"};

    double width = 0.5;
    double height = 0.5;
    double depth = 0.5;
    std::string braces = "one";
    Elasticity elasticity{};
    double mass = 1;
    double thickness = 0.04;
    double dot = 0.05;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6;
        visit(self.width, Field{.name = "width", .help = "Width", .unit = unit::length, .low = min, .high = max});
        visit(self.height, Field{.name = "height", .help = "Height", .unit = unit::length, .low = min, .high = max});
        visit(self.depth,
              Field{.name = "depth", .help = "Depth, in 3D", .unit = unit::length, .low = min, .high = max});
        visit(self.braces,
              Field{.name = "braces",
                    .help =
                        "Diagonals of each face: one (2D: from the top left to the bottom right), both, or none (the "
                        "box can then fold)",
                    .choices = bracings});
        Elasticity::fields(self.elasticity, visit, "Compliance of edges and diagonals; 0 is rigid");
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of the drawn edges",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = max});
        visit(self.dot, Field{.name = "dot",
                              .help = "Diameter of the corners; collision radius is half",
                              .unit = unit::length,
                              .low = 0,
                              .high = max});
    }

    Sizes sizes() const { return {.particles = 8, .constraints = 24}; }
    template <int D, class Real> void build(Builder<D, Real>& figure) const;

  private:
    template <class Real> void build_square(Builder<2, Real>& figure) const;
};

} // namespace sinew

#pragma once

#include "sinew/prefab/builder.h"
#include "sinew/prefab/material.h"
#include "sinew/prefab/obj.h"

#include <memory>
#include <optional>
#include <string>

namespace sinew {

/// A soft solid about the figure's position: a ball, or the inside of a closed mesh, filled with tetrahedra
/// (tetrahedra.h). Particles vertex_0, ...; constraints edge_0, ... along the edges of the tetrahedra, then volume_0,
/// ..., one a tetrahedron.
struct Jelly {
    static constexpr std::string_view name = "jelly";
    static constexpr std::string_view about = "A soft solid: a ball, or any closed OBJ file, filled with tetrahedra.";
    static constexpr Dimensions dimensions{3, 3};

    std::string file{};
    double size = 1;
    int cells = 6;
    double mass = 5;
    Elasticity elasticity{2e-3 /* m/N */};
    double least_volume = 0.3;
    Strength strength{};
    double thickness = 0.02;

    /// Content of the file, read by whoever opens the scene. Without a file the solid is a ball of diameter `size`.
    std::shared_ptr<const MeshModel> model{};

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.file, Field{.name = "file", .help = "Closed OBJ file in the scene's folder; a ball if left out"});
        visit(self.size, Field{.name = "size",
                               .help = "Diameter of the ball; length of one unit of the file",
                               .unit = unit::length,
                               .low = 1e-6,
                               .high = 1e6});
        visit(self.cells,
              Field{.name = "cells", .help = "Cells of the lattice along the longest side", .low = 2, .high = 12});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        Elasticity::fields(self.elasticity, visit, "Compliance of an edge; 0 is rigid");
        visit(self.least_volume, Field{.name = "least_volume",
                                       .help = "Share of its volume below which no tetrahedron can be crushed, so that "
                                               "none turns inside out",
                                       .low = 0,
                                       .high = 1});
        Strength::fields(self.strength, visit, "Strain at which an edge tears; 0 for never");
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Collision diameter of the particles",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
    }

    Sizes sizes() const;
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

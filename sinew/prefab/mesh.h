#pragma once

#include "sinew/prefab/builder.h"
#include "sinew/prefab/material.h"
#include "sinew/prefab/obj.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// Cloth of any shape: the points of an OBJ file become particles, the edges of its faces threads. Particles vertex_0
/// (the first of the file), vertex_1, ...; constraints edge_0, ... in the order in which the faces first use each edge,
/// diagonals last.
struct Mesh {
    static constexpr std::string_view name = "mesh";
    static constexpr std::string_view about = "Cloth of any shape from an OBJ file: points linked along the edges.";
    static constexpr Dimensions dimensions{2, 3};
    static constexpr std::array<std::string_view, 2> drawings{"fill", "threads"};

    std::string file{};
    double size = 1;
    bool diagonals = true;
    double buckling = 0;
    std::vector<double> pin_list{};
    bool tethers = true;
    double mass = 1;
    Elasticity elasticity{};
    Strength strength{};
    std::string drawn = "fill";
    double thickness = 0.01;

    /// Content of the file, read by whoever opens the scene. Without a file the mesh is a square of four triangles.
    std::shared_ptr<const MeshModel> model{};
    bool unseen = false; ///< true: nothing is drawn, which saves the memory of the pieces

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.file, Field{.name = "file", .help = "OBJ file in the scene's folder; a square if left out"});
        visit(self.size, Field{.name = "size",
                               .help = "Length of one unit of the file",
                               .unit = unit::length,
                               .low = 1e-6,
                               .high = 1e6});
        visit(
            self.diagonals,
            Field{
                .name = "diagonals",
                .help =
                    "Extra threads from each corner of a face to the next but one, for faces of four corners or more"});
        visit(self.buckling,
              Field{.name = "buckling",
                    .help = "Largest shortening of an edge as a share of its length, for cloth that buckles between "
                            "points. With 0 all edges also push, and crumpled cloth can jam",
                    .low = 0,
                    .high = 1});
        visit(self.pin_list,
              Field{.name = "pin_list", .help = "Points held in place, counted from 0", .low = 0, .high = 4e9});
        visit(
            self.tethers,
            Field{
                .name = "tethers",
                .help =
                    "Limit on the distance from held points, the length of the edges between, which reduces stretch"});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        Elasticity::fields(self.elasticity, visit, "Compliance of an edge; 0 is inextensible");
        Strength::fields(self.strength, visit, "Strain at which an edge tears; 0 for never");
        visit(self.drawn, Field{.name = "drawn", .help = "Drawn as filled faces or as edges", .choices = drawings});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of a drawn edge; collision radius is half",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
    }

    Sizes sizes() const;
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

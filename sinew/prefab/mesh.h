#pragma once

#include "sinew/prefab/builder.h"
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
    static constexpr std::string_view about = "Cloth of any cut, from an OBJ file: its points tied along the edges.";
    static constexpr Dimensions dimensions{2, 3};
    static constexpr std::array<std::string_view, 2> drawings{"fill", "threads"};

    std::string file{};
    double size = 1;
    bool diagonals = true;
    double buckling = 0;
    std::vector<double> pin_list{};
    bool tethers = true;
    double mass = 1;
    double compliance = 0;
    double breaking_strain = 0;
    double toughness = 0;
    std::string drawn = "fill";
    double thickness = 0.01;

    /// Content of the file, read by whoever opens the scene. Without a file the mesh is a square of four triangles.
    std::shared_ptr<const MeshModel> model{};
    bool unseen = false; ///< true: nothing is drawn, which saves the memory of the pieces

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.file, Field{.name = "file", .help = "An OBJ file in the scene's folder; left out: a square"});
        visit(
            self.size,
            Field{.name = "size", .help = "How long 1 in the file is", .unit = unit::length, .low = 1e-6, .high = 1e6});
        visit(self.diagonals,
              Field{.name = "diagonals",
                    .help = "Faces of four corners and more are also tied from each corner to the next but one"});
        visit(self.buckling, Field{.name = "buckling",
                                   .help = "By what part of its length an edge may become shorter, as in cloth that "
                                           "buckles between two points. With 0 all push, and crumpled cloth can jam",
                                   .low = 0,
                                   .high = 1});
        visit(self.pin_list,
              Field{.name = "pin_list", .help = "Points that are held, counted from 0", .low = 0, .high = 4e9});
        visit(self.tethers, Field{.name = "tethers",
                                  .help = "Nothing gets further from what is held than the edges reach: it sags less"});
        visit(self.mass, Field{.name = "mass", .help = "Of the whole", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.compliance, Field{.name = "compliance",
                                     .help = "How much an edge gives under a force; 0 does not stretch",
                                     .unit = unit::compliance,
                                     .low = 0,
                                     .high = 1e9});
        visit(self.breaking_strain, Field{.name = "breaking_strain",
                                          .help = "An edge stretched by this fraction tears; 0 never tears",
                                          .low = 0,
                                          .high = 1e6});
        visit(self.toughness, toughness_field);
        visit(self.drawn, Field{.name = "drawn", .help = "Its faces filled, or its edges", .choices = drawings});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Of a drawn edge; it stays half of it away from walls",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = 1e6});
    }

    Sizes sizes() const;
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

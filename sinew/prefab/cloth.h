#pragma once

#include "sinew/prefab/builder.h"
#include "sinew/prefab/material.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// A grid of particles, positioned by the middle of the top row. Particles particle_0_0 (top left), particle_1_0 to the
/// right, particle_0_1 below, ...; the corners are also called top_left, top_right, bottom_left, bottom_right.
///
/// Constraints, in this order: across_0_0 (particle_0_0 to particle_1_0), ... of all rows; down_0_0 (to particle_0_1),
/// ...; falling_0_0 (to particle_1_1), ...; rising_0_0 (particle_1_0 to particle_0_1), ...; with bend also
/// bend_across_0_0 (to particle_2_0), ... and bend_down_0_0 (to particle_0_2), .... The order matters for convergence:
/// one direction after the other left a quarter of the stretch of a random order, and cell by cell diverged.
struct Cloth {
    static constexpr std::string_view name = "cloth";
    static constexpr std::string_view about = "A piece of cloth: a grid of threads that drapes, flutters and can tear.";
    static constexpr Dimensions dimensions{2, 3};
    static constexpr std::array<std::string_view, 5> pin_rules{"top", "corners", "all_corners", "list", "none"};
    static constexpr std::array<std::string_view, 2> planes{"vertical", "horizontal"};
    static constexpr std::array<std::string_view, 3> diagonal_rules{"both", "one", "none"};
    static constexpr std::array<std::string_view, 3> drawings{"threads", "fill", "both"};

    int columns = 20;
    int rows = 20;
    double spacing = 0.1;
    std::string plane = "vertical";
    std::string pins = "top";
    std::vector<double> pin_list{};
    std::string diagonals = "both";
    double buckling = 0;
    bool bend = false;
    double mass = 1;
    Elasticity elasticity{};
    Elasticity shear_elasticity{};
    Elasticity bend_elasticity{0.1 /* m/N */};
    Strength strength{};
    double uneven = 0;
    bool tethers = true;
    std::string drawn = "threads";
    double thickness = 0.01;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6;
        visit(self.columns, Field{.name = "columns", .help = "Particles from left to right", .low = 2, .high = 1e9});
        visit(self.rows, Field{.name = "rows", .help = "Particles from top to bottom", .low = 2, .high = 1e9});
        visit(self.spacing, Field{.name = "spacing",
                                  .help = "Distance between neighbouring particles",
                                  .unit = unit::length,
                                  .low = min,
                                  .high = max});
        visit(self.plane, Field{.name = "plane",
                                .help = "Initial plane: vertical hangs from the top row; horizontal (3D) is level, "
                                        "with the top row furthest away",
                                .choices = planes});
        visit(self.pins, Field{.name = "pins",
                               .help = "Particles held in place: the top row, its two corners, all four corners, the "
                                       "particles in pin_list, or none",
                               .choices = pin_rules});
        visit(self.pin_list, Field{.name = "pin_list",
                                   .help = "Particles held with pins = list, counted row by row, 0 at the top left",
                                   .low = 0,
                                   .high = 4e9});
        visit(self.diagonals, Field{.name = "diagonals",
                                    .help = "Diagonal threads in each cell, against shear",
                                    .choices = diagonal_rules});
        visit(self.buckling,
              Field{.name = "buckling",
                    .help =
                        "Largest shortening of a thread as a share of its length, for cloth that buckles between "
                        "particles; diagonals then only pull. With 0 all threads also push, and crumpled cloth can jam",
                    .low = 0,
                    .high = 1});
        visit(self.bend, Field{.name = "bend", .help = "Bending springs from each particle to the next but one"});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        Elasticity::fields(self.elasticity, visit, "Compliance of a thread; 0 is inextensible");
        Elasticity::fields(self.shear_elasticity, visit, "Compliance of the diagonals; 0 is inextensible", 0,
                           "shear_compliance");
        Elasticity::fields(self.bend_elasticity, visit, "Compliance of the bending springs; 0 is rigid", 0,
                           "bend_compliance");
        Strength::fields(self.strength, visit, "Strain at which a thread tears; 0 for never");
        visit(
            self.uneven,
            Field{.name = "uneven",
                  .help =
                      "Random extra strength of each thread, as a share of breaking_strain: 1 is up to twice as strong",
                  .low = 0,
                  .high = 1e3});
        visit(self.tethers, Field{.name = "tethers",
                                  .help = "Limit on the distance from the pins, the length of the threads between, "
                                          "which reduces stretch. None where threads can tear or stretch"});
        visit(self.drawn,
              Field{.name = "drawn", .help = "Drawn as threads, as filled cells, or both", .choices = drawings});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of a drawn thread; collision radius is half",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = max});
    }

    Sizes sizes() const;
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

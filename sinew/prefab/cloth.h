#pragma once

#include "sinew/prefab/builder.h"

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
    double compliance = 0;
    double shear_compliance = 0;
    double bend_compliance = 0.1;
    double breaking_strain = 0;
    double toughness = 0;
    double uneven = 0;
    bool tethers = true;
    std::string drawn = "threads";
    double thickness = 0.01;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double least = 1e-6, most = 1e6, softest = 1e9;
        visit(self.columns, Field{.name = "columns", .help = "Particles from left to right", .low = 2, .high = 1e9});
        visit(self.rows, Field{.name = "rows", .help = "Particles from top to bottom", .low = 2, .high = 1e9});
        visit(self.spacing, Field{.name = "spacing",
                                  .help = "From one particle to the next",
                                  .unit = unit::length,
                                  .low = least,
                                  .high = most});
        visit(self.plane, Field{.name = "plane",
                                .help = "vertical hangs from its top row; horizontal (3D) lies level, its top row "
                                        "furthest away",
                                .choices = planes});
        visit(self.pins, Field{.name = "pins",
                               .help = "What holds it: its top row, the two corners of that, all four corners, "
                                       "the particles in pin_list, or nothing",
                               .choices = pin_rules});
        visit(self.pin_list, Field{.name = "pin_list",
                                   .help = "With pins = list: particles counted row by row, 0 at the top left",
                                   .low = 0,
                                   .high = 4e9});
        visit(self.diagonals, Field{.name = "diagonals",
                                    .help = "Threads across each cell, which resist shear",
                                    .choices = diagonal_rules});
        visit(self.buckling, Field{.name = "buckling",
                                   .help = "By what part of its length a thread may become shorter, as in cloth that "
                                           "buckles between two particles; diagonals then only pull. With 0 all push, "
                                           "and crumpled cloth can jam",
                                   .low = 0,
                                   .high = 1});
        visit(self.bend, Field{.name = "bend", .help = "Springs from each particle to the next but one"});
        visit(self.mass, Field{.name = "mass", .help = "Of the whole", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.compliance, Field{.name = "compliance",
                                     .help = "How much a thread gives under a force; 0 does not stretch",
                                     .unit = unit::compliance,
                                     .low = 0,
                                     .high = softest});
        visit(self.shear_compliance, Field{.name = "shear_compliance",
                                           .help = "The same of the diagonals",
                                           .unit = unit::compliance,
                                           .low = 0,
                                           .high = softest});
        visit(self.bend_compliance, Field{.name = "bend_compliance",
                                          .help = "The same of the bend springs",
                                          .unit = unit::compliance,
                                          .low = 0,
                                          .high = softest});
        visit(self.breaking_strain, Field{.name = "breaking_strain",
                                          .help = "A thread stretched by this fraction tears; 0 never tears",
                                          .low = 0,
                                          .high = most});
        visit(self.toughness, toughness_field);
        visit(self.uneven, Field{.name = "uneven",
                                 .help = "How much more than breaking_strain some threads bear, at random: 1 is up to "
                                         "twice as much",
                                 .low = 0,
                                 .high = 1e3});
        visit(self.tethers, Field{.name = "tethers",
                                  .help = "Nothing gets further from a pin than the threads reach. Where threads may "
                                          "tear or give there are none"});
        visit(self.drawn,
              Field{.name = "drawn", .help = "Its threads, its cells filled, or both", .choices = drawings});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Of a drawn thread; it stays half of it away from walls",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = most});
    }

    Sizes sizes() const;
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

#pragma once

#include "sinew/prefab/builder.h"

#include <optional>
#include <string>

namespace sinew {

/// Loose balls in a staggered grid, positioned by the middle of the centres of the lowest row. Particles ball_0,
/// ball_1, ... by columns, then rows, then layers.
struct Balls {
    static constexpr std::string_view name = "balls";
    static constexpr std::string_view about = "Loose balls in a grid: marbles, sand. Switch on \"contact\" \"itself\". "
                                              "The lowest row lies on a floor that is "
                                              "a radius below \"at\".";
    static constexpr Dimensions dimensions{2, 3};

    int columns = 10;
    int rows = 10;
    int layers = 1;
    double radius = 0.1;
    double gap = 0.02;
    double mass = 10;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.columns, Field{.name = "columns", .help = "Balls side by side", .low = 1, .high = 1e6});
        visit(self.rows, Field{.name = "rows", .help = "Balls above each other", .low = 1, .high = 1e6});
        visit(self.layers, Field{.name = "layers", .help = "Balls behind each other (3D)", .low = 1, .high = 1e6});
        visit(self.radius,
              Field{.name = "radius", .help = "Radius of a ball", .unit = unit::length, .low = 1e-6, .high = 1e6});
        visit(self.gap, Field{.name = "gap",
                              .help = "Distance between the surfaces of neighbours",
                              .unit = unit::length,
                              .low = 0,
                              .high = 1e6});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
    }

    Sizes sizes() const { return {.particles = std::size_t(columns) * std::size_t(rows) * std::size_t(layers)}; }
    std::optional<std::string> problem(int dimension) const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

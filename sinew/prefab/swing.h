#pragma once

#include "sinew/prefab/strand.h"

namespace sinew {

/// A seat on two ropes, positioned by the point midway between the hooks. Particles left_0 (also called left_hook),
/// ..., the last also called seat_left; right_0 (right_hook), ..., seat_right. Constraints left_link_0, ...,
/// right_link_0, ... from the hooks down, and seat. In classic mode the links are rigid rods.
struct Swing {
    static constexpr std::string_view name = "swing";
    static constexpr std::string_view about = "A seat on two ropes.";
    static constexpr Dimensions dimensions{2, 3};

    double length = 1.8;
    double width = 0.6;
    int segments = 12;
    double angle = 0; ///< radians
    double mass = 4;
    double weight = 0;
    double thickness = 0.03;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6;
        visit(self.length, Field{.name = "length",
                                 .help = "Length of each rope, from hook to seat",
                                 .unit = unit::length,
                                 .low = min,
                                 .high = max});
        visit(self.width, Field{.name = "width",
                                .help = "Width of the seat, from rope to rope",
                                .unit = unit::length,
                                .low = min,
                                .high = max});
        visit(self.segments,
              Field{.name = "segments", .help = "Number of straight pieces of a rope", .low = 1, .high = 1e9});
        visit(
            self.angle,
            Field{.name = "angle",
                  .help = "Initial direction of the ropes: 0 hangs straight down, a quarter turn is level to the right",
                  .unit = unit::angle,
                  .low = -2 * pi<double>,
                  .high = 2 * pi<double>});
        visit(self.mass, Field{.name = "mass",
                               .help = "Total mass, half of which belongs to the seat",
                               .unit = unit::mass,
                               .low = 1e-6,
                               .high = 1e9});
        visit(
            self.weight,
            Field{.name = "weight", .help = "Additional mass on the seat", .unit = unit::mass, .low = 0, .high = 1e9});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of a rope as drawn; the seat is twice as thick",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = max});
    }

    Sizes sizes() const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

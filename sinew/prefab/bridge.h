#pragma once

#include "sinew/prefab/strand.h"

namespace sinew {

/// A bridge of planks joined end to end between two banks, positioned by the left bank. Particles joint_0 (also called
/// left_bank), ..., the last also called right_bank; constraints plank_0 (joint_0 to joint_1), .... A rail adds
/// particles rail_0, ... above the joints, held above the banks, constraints rail_link_0, ... along the rail, and
/// hanger_0 (joint_1 to rail_1), ....
struct Bridge {
    static constexpr std::string_view name = "bridge";
    static constexpr std::string_view about =
        "A bridge of planks hanging between two banks, with or without a rail of rope.";
    static constexpr Dimensions dimensions{2, 3};

    double span = 4;
    int planks = 16;
    double slack = 0.04;
    double rail = 0;
    double mass = 40;
    double thickness = 0.08;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        constexpr double min = 1e-6, max = 1e6;
        visit(
            self.span,
            Field{.name = "span", .help = "Distance between the banks", .unit = unit::length, .low = min, .high = max});
        visit(self.planks, Field{.name = "planks", .help = "Number of planks", .low = 2, .high = 1e9});
        visit(self.slack, Field{.name = "slack",
                                .help = "Excess of the length over the distance between the banks: 0.1 is 10 %",
                                .low = 0,
                                .high = 100});
        visit(self.rail, Field{.name = "rail",
                               .help = "Height of a rope above the planks; 0 for no rope",
                               .unit = unit::length,
                               .low = 0,
                               .high = max});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.thickness, Field{.name = "thickness",
                                    .help = "Thickness of a plank; collision radius is half",
                                    .unit = unit::length,
                                    .low = 0,
                                    .high = max});
    }

    Sizes sizes() const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

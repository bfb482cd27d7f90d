#pragma once

#include "sinew/prefab/builder.h"

namespace sinew {

/// A matchstick man, positioned by the neck. Particles head, neck, hips and, left and right as on screen, left_elbow,
/// left_hand, left_knee, left_foot, right_elbow, right_hand, right_knee, right_foot. The sticks are drawn; the supports
/// that hold the figure in shape are hidden.
struct StickFigure {
    static constexpr std::string_view name = "stick_figure";
    static constexpr std::string_view about = "A matchstick man: drawn sticks, held in shape by hidden supports.";
    static constexpr Dimensions dimensions{2, 2};

    double height = 1.6;
    double mass = 70;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(
            self.height,
            Field{
                .name = "height", .help = "Height from head to foot", .unit = unit::length, .low = 1e-3, .high = 1e5});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
    }

    Sizes sizes() const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

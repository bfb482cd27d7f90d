#pragma once

#include "sinew/prefab/builder.h"

namespace sinew {

/// A matchstick man of eleven particles with a mass for each part of the body, positioned by the meeting point of the
/// shoulders. Particles head, shoulder, pelvis, left_ and right_ elbow, hand, knee, foot. Classic mode: the man of the
/// tearable cloth demo with its masses, soft spine and hidden, very soft supports. Physical mode: rigid limbs, a head
/// that stays upright on the neck, and knees and elbows that bend one way only.
struct Puppet {
    static constexpr std::string_view name = "puppet";
    static constexpr std::string_view about = "A light matchstick man, for crowds.";
    static constexpr Dimensions dimensions{2, 2};
    static constexpr bool weighs_in_classic = true;

    double height = 0.4;
    double mass = 83;
    double thickness = 0.02;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.height, Field{.name = "height",
                                 .help = "Height from shoulder to foot: 7.5 heads",
                                 .unit = unit::length,
                                 .low = 1e-3,
                                 .high = 1e5});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(
            self.thickness,
            Field{
                .name = "thickness", .help = "Thickness of a drawn line", .unit = unit::length, .low = 0, .high = 1e5});
    }

    Sizes sizes() const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

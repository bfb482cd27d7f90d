#pragma once

#include "sinew/prefab/builder.h"

namespace sinew {

/// A cartoon man, positioned by the root particle between the shoulders. Particles root, head and, left and right as on
/// screen, left_ and right_ shoulder, hip, elbow, hand, knee, foot. Each arm and leg is drawn as one band along the
/// quadratic Bezier curve of its three particles; hands and shoes follow the end tangent of the curve.
///
/// Classic mode: the original's 14 particles and 11 links, whose trunk the game holds. Physical mode: eight more links
/// make the trunk rigid.
struct Humanoid {
    static constexpr std::string_view name = "humanoid";
    static constexpr std::string_view about = "A cartoon man with limbs that bend like hoses.";
    static constexpr Dimensions dimensions{2, 2};

    double height = 2.16;
    double mass = 25;

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

#pragma once

#include "sinew/prefab/builder.h"

namespace sinew {

/// A human figure seen from the front, standing where the middle between its shoulders is. Left and right are as one
/// sees them: left_hand is on the left of the screen. Particles left_ and right_ shoulder, hip, elbow, hand, knee,
/// foot.
///
/// Classic: the original's 15 points (besides these head_left, head_right and center, which is tied to nothing) and 21
/// segments, all alike. Physical: particles neck and head, masses by body part, knees and elbows that bend one way,
/// head and hips in a range, and none of the original's hidden beams.
struct Ragdoll {
    static constexpr std::string_view name = "ragdoll";
    static constexpr std::string_view about = "A limp human figure to drop, throw and drag about.";
    static constexpr Dimensions dimensions{2, 2};

    double height = 1.6;
    double mass = 70;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.height,
              Field{.name = "height", .help = "From head to foot", .unit = unit::length, .low = 1e-3, .high = 1e5});
        visit(self.mass, Field{.name = "mass", .help = "Of the whole", .unit = unit::mass, .low = 1e-6, .high = 1e9});
    }

    Sizes sizes() const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

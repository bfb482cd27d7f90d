#pragma once

#include "sinew/prefab/builder.h"

#include <array>
#include <string>
#include <string_view>

namespace sinew {

/// A human figure seen from the front, positioned by the point midway between the shoulders. Left and right are those
/// of the screen: left_hand is on the left. Particles left_ and right_ shoulder, hip, elbow, hand, knee, foot.
///
/// Classic mode in 2D: the original's 15 points (besides these head_left, head_right and center, which has no
/// constraints) and 21 segments of equal masses. Physical mode: particles neck and head, masses by body part, knees and
/// elbows that bend one way only, limited head and hips, and none of the original's hidden beams. In 3D the front faces
/// +z in both modes, and classic mode draws bones as sticks and joint limits as threads.
struct Ragdoll {
    static constexpr std::string_view name = "ragdoll";
    static constexpr std::string_view about = "A limp human figure to drop, throw and drag about.";
    static constexpr Dimensions dimensions{2, 3};
    static constexpr std::array<std::string_view, 3> builds{"slim", "normal", "heavy"};
    static constexpr std::array<std::string_view, 4> poses{"standing", "star", "hands_up", "dancing"};

    double height = 1.6;
    double mass = 70;
    std::string stature = "normal";
    std::string pose = "standing";

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(
            self.height,
            Field{
                .name = "height", .help = "Height from head to foot", .unit = unit::length, .low = 1e-3, .high = 1e5});
        visit(self.mass, Field{.name = "mass", .help = "Total mass", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.stature, Field{.name = "build", .help = "Breadth of trunk and limbs", .choices = builds});
        visit(self.pose, Field{.name = "pose", .help = "Initial pose of the limbs", .choices = poses});
    }

    Sizes sizes() const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

#pragma once

#include "sinew/prefab/builder.h"

#include <array>
#include <string>
#include <string_view>

namespace sinew {

/// A human figure seen from the front, standing where the middle between its shoulders is. Left and right are as one
/// sees them: left_hand is on the left of the screen. Particles left_ and right_ shoulder, hip, elbow, hand, knee,
/// foot.
///
/// Classic: the original's 15 points (besides these head_left, head_right and center, which is tied to nothing) and 21
/// segments, all alike. Physical: particles neck and head, masses by body part, knees and elbows that bend one way,
/// head and hips in a range, and none of the original's hidden beams. In space its front is towards z, in either mode;
/// classic mode draws its bones as sticks and what keeps joints in their ranges as threads.
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
        visit(self.height,
              Field{.name = "height", .help = "From head to foot", .unit = unit::length, .low = 1e-3, .high = 1e5});
        visit(self.mass, Field{.name = "mass", .help = "Of the whole", .unit = unit::mass, .low = 1e-6, .high = 1e9});
        visit(self.stature, Field{.name = "build", .help = "How broad trunk and limbs are", .choices = builds});
        visit(self.pose, Field{.name = "pose", .help = "How it holds its limbs at first", .choices = poses});
    }

    Sizes sizes() const;
    template <int D, class Real> void build(Builder<D, Real>& figure) const;
};

} // namespace sinew

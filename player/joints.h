#pragma once

#include <array>
#include <string_view>

namespace sinew::play {

/// A joint that the join tool makes.
struct Joint {
    std::string_view name, about;
};

inline constexpr std::array<Joint, 5> joints = {{
    {"hinge", "both turn about one place; ends that are apart are kept apart by a rod"},
    {"spring", "a spring, which swings in half a second"},
    {"weld", "both move as one body"},
    {"motor", "a hinge that turns half a turn a second, as far as its torque goes"},
    {"winch", "a rope that is wound up to a tenth of its length in two seconds"},
}};

} // namespace sinew::play

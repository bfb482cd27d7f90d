#pragma once

#include "sinew/solver/world.h"

#include <string>

namespace sinew {

/// Something about a rig that cannot be, or not be as it stands.
struct RigFault {
    std::string what;  ///< in a sentence: "is 1.2, its limits are 2 to 3"
    std::string where; ///< figure/name of a constraint or particle; else its particles
};

/// What is wrong with a world as it stands, in the order of its constraints; at most `most`. Only what is rigid counts,
/// for springs may be strained. Found are
///   - limits that nothing can meet: a low above its high, a distance below zero, a turn beyond a half in space;
///   - limits that the pose breaks by more than a thousandth of the length (of a radian);
///   - lengths that cannot all be: a way of links around a distance that is shorter than it, or between two particles
///     that are held;
///   - loops of links whose particles have no mass to move by, which nothing can move.
/// Ways are followed for `most_ways` links altogether: in a larger world the last are not looked at.
template <int D, class Real> std::vector<RigFault> rig_faults(const World<D, Real>& world, std::size_t most = 100);
inline constexpr std::size_t most_ways = 10'000'000;

} // namespace sinew

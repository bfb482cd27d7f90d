#pragma once

#include "sinew/world/world.h"

#include <string>

namespace sinew {

/// Defect of a rig.
struct RigFault {
    std::string what;  ///< end of a sentence: "is 1.2, its limits are 2 to 3"
    std::string where; ///< figure/name of a constraint or particle; otherwise the particles
};

/// Defects of a world in the present pose, at most `max`:
///   - impossible limits: low above high, a distance below zero, a 3D angle outside 0 to 180 degrees;
///   - rigid constraints violated by the pose, by a strain above 1e-3 (radians for angles);
///   - lengths in contradiction: too short a path of links around a rigid distance, or between two held particles;
///   - loops of links between particles of zero inverse mass, which nothing can move.
/// Paths follow `max_ways` links altogether: in a larger world the last are not examined.
template <int D, class Real> std::vector<RigFault> rig_faults(const World<D, Real>& world, std::size_t max = 100);
inline constexpr std::size_t max_ways = 10'000'000;

} // namespace sinew

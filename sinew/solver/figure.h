#pragma once

#include "sinew/solver/id.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// How a part of a figure is drawn.
enum class Mark : std::uint8_t {
    stroke, ///< a line through its particles
    loop,   ///< the same, closed
    dot,    ///< a disc at each particle
    fill,   ///< a filled polygon
    surface ///< 3D: a filled polygon shaded by its tilt
};

/// One drawn piece. What it looks like is said by the scene's looks, by part ("arm", "head"), so that a figure stays
/// one thing in any colours; how thick it is belongs to its shape.
struct Piece {
    Mark mark = Mark::stroke;
    std::string part{};
    std::vector<ParticleId> particles{};
    double width = 0;    ///< in world units: line thickness or disc diameter; 0 leaves it to the looks
    bool hidden = false; ///< a support that is only drawn when asked for
};

/// What a prefab built: names for its particles and constraints, and what to draw. Positions are elsewhere, in columns.
struct Figure {
    std::string name{};
    std::string prefab{};
    std::vector<ParticleId> particles{};
    std::vector<ConstraintId> constraints{};
    std::vector<std::pair<std::string, ParticleId>> particle_names{}; ///< in the order they were given
    std::vector<std::pair<std::string, ConstraintId>> constraint_names{};
    std::vector<Piece> pieces{};
    bool quarantined = false;
};

} // namespace sinew

#pragma once

#include "sinew/session/session.h"

#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// Candidate of a grab.
struct Picked {
    std::vector<ParticleId> members; ///< a single particle, or several with `place` between them
    Point position;                  ///< position in the world
    double depth = 0;                ///< distance from the eye along the view axis; 0 in 2D
    Vec2<float> pixel{};             ///< projected position
    FigureIndex figure = no_figure;
};

/// Nearest movable particle within `radius` pixels; otherwise a point on a line between two particles or, in 2D, within
/// a filled polygon. Empty if there is none.
std::optional<Picked> pick(const AnyWorld& world, const View& view, Vec2<double> pixel, double radius);

/// Radius of a pointer's grab, pixels.
inline constexpr double pick_radius = 18;

/// Name of a particle: "bob/right_hand"; "bob" if the particle has no name; empty if removed or of no figure.
std::string name_of(const AnyWorld& world, ParticleId id);

/// Present mean position of a pick's members; empty if one has been removed.
std::optional<Point> position_of(const AnyWorld& world, std::span<const ParticleId> members);

} // namespace sinew

#pragma once

#include "sinew/session/session.h"

#include <optional>
#include <string>
#include <vector>

namespace sinew {

/// What a pointer can take hold of.
struct Picked {
    std::vector<ParticleId> members; ///< one particle, or several with the place between them
    Point place;                     ///< of the world
    double depth = 0;                ///< distance from the eye; 0 in 2D
    Vec2<float> pixel{};             ///< where it is seen
    FigureIndex figure = no_figure;
};

/// The nearest particle within so many pixels, or else a place on a line between two or within a filled polygon. Only
/// what can move; nothing where there is none.
std::optional<Picked> pick(const AnyWorld& world, const View& view, Vec2<double> pixel, double radius);

/// How near, in pixels, a pointer must be to what it takes hold of.
inline constexpr double pick_radius = 18;

/// "bob/right_hand"; "bob" where the particle has no name; empty where it is gone or loose.
std::string name_of(const AnyWorld& world, ParticleId id);

/// Where the middle of what was picked is now; nothing where part of it is gone.
std::optional<Point> place_of(const AnyWorld& world, std::span<const ParticleId> members);

} // namespace sinew

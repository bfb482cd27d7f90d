#pragma once

#include "sinew/world/world.h"

#include <optional>
#include <vector>

/// Questions about what is where. A question looks at every particle, link and collider once; nothing is changed.
namespace sinew {

template <int D, class Real> struct NearParticle {
    ParticleId particle{};
    Real distance = 0; ///< from the particle's surface; negative inside
};
/// Nearest particle whose surface is within `radius` of a point; the one added first among equals.
template <int D, class Real>
std::optional<NearParticle<D, Real>> nearest_particle(const World<D, Real>& world, const Vec<D, Real>& point,
                                                      Real radius);

template <int D, class Real> struct NearLink {
    ConstraintId link{}; ///< a distance
    Real t = 0;          ///< parameter from the first end to the second, 0..1
    Real distance = 0;   ///< from the line between the ends
};
/// Nearest link within `radius` of a point: the segment between the ends of a distance that holds them together.
template <int D, class Real>
std::optional<NearLink<D, Real>> nearest_link(const World<D, Real>& world, const Vec<D, Real>& point, Real radius);

/// First thing met by a ray, or by a sphere that moves.
template <int D, class Real> struct RayHit {
    Real time = 0; ///< fraction of the motion, 0..1
    Vec<D, Real> point{}, normal{};
    ParticleId particle{}; ///< of a particle, or the first end of a line
    ColliderId collider{}; ///< of a collider
    bool is_collider = false;
    bool is_plane = false;                ///< of World::bounds
    FigureIndex figure = no_figure;       ///< of a particle or a line
    std::optional<ParticleId> line_end{}; ///< of a line of a figure
};
/// First particle with a radius, line of a figure as it is drawn (the side of a crate, a limb), collider other than a
/// sensor, or plane of World::bounds that a sphere meets on its way from a point; radius 0 is a ray. Only what `filter`
/// touches counts, and planes always do. `mover`: the figure in whose place the sphere moves; neither it nor figures
/// that it does not touch count.
template <int D, class Real>
std::optional<RayHit<D, Real>> cast_ray(const World<D, Real>& world, const Vec<D, Real>& from,
                                        const Vec<D, Real>& displacement, Real radius = 0, collide::Filter filter = {},
                                        FigureIndex mover = no_figure);

/// Particles that touch a shape, in the order of their rows.
template <int D, class Real>
std::vector<ParticleId> overlapping_particles(const World<D, Real>& world, const collide::Shape<D, Real>& shape,
                                              const collide::Pose<D, Real>& pose);
/// Links that touch a shape, in the order of their rows.
template <int D, class Real>
std::vector<ConstraintId> overlapping_links(const World<D, Real>& world, const collide::Shape<D, Real>& shape,
                                            const collide::Pose<D, Real>& pose);

/// Figures that touch a shape with a particle or a line, or that enclose it, in the order of their indices.
template <int D, class Real>
std::vector<FigureIndex> overlapping_figures(const World<D, Real>& world, const collide::Shape<D, Real>& shape,
                                             const collide::Pose<D, Real>& pose);

} // namespace sinew

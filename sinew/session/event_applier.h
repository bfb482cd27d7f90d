#pragma once

#include "sinew/math/random.h"
#include "sinew/scene/join.h"
#include "sinew/scene/scene.h"
#include "sinew/topology/cut.h"

namespace sinew {

template <class WorldT> Gravity<WorldT::dimension, typename WorldT::Real>* gravity_of(WorldT& world) {
    return world.forces.empty() ? nullptr
                                : std::get_if<Gravity<WorldT::dimension, typename WorldT::Real>>(&world.forces.front());
}

/// Velocity change of the `number`-th particle of a kick's target: uniform in [-by, by) on each axis, drawn from the
/// scene's seed and the count of earlier occurrences.
template <int D, class Real>
Vec<D, Real> kick_of(const KickEvent& kick, const Scene& scene, std::size_t number, std::uint64_t before) {
    const auto by = kick.by.template as<D, Real>();
    const auto seed = std::uint64_t(kick.seed) ^ random::mix(std::uint64_t(scene.solver.seed));
    return Vec<D, Real>::map(
        [&](int axis) { return by[axis] * random::symmetric<Real>(seed, 3 * number + std::uint64_t(axis), before); });
}

/// Applies an event to a world. Returns the name of the figure, particle or constraint concerned; empty if nothing
/// happened or the event has no place.
template <class WorldT> struct EventApplier {
    using Real = typename WorldT::Real;
    static constexpr int D = WorldT::dimension;
    WorldT& world;
    const Scene& scene;
    std::uint64_t before = 0; ///< number of earlier occurrences of the same event

    std::string operator()(const KickEvent& kick) const {
        std::size_t number = 0;
        for (const auto id : find_particles(world, kick.target))
            set_velocity(world, id, *velocity_of(world, id) + kick_of<D, Real>(kick, scene, number++, before));
        return kick.target;
    }

    std::string operator()(const JoinEvent& event) const {
        const auto& members = event.constraint.between;
        const auto first = find_particle(world, members[0]), second = find_particle(world, members[1]);
        if (!first || !second) return "";
        if (event.within > 0 &&
            distance(*position_of(world, *first), *position_of(world, *second)) > Real(event.within))
            return "";
        const auto of = members[0].substr(0, members[0].find('/'));
        if (!event.constraint.name.empty() && find_constraint(world, of + "/" + event.constraint.name)) return "";
        const auto figure = find_figure(world, of);
        join(world, event.constraint, figure.value_or(no_figure));
        return members[0];
    }

    std::string operator()(const ImpulseEvent& impulse) const {
        const auto by = impulse.by.template as<D, Real>();
        if (const auto particle = find_particle(world, impulse.target)) {
            apply_impulse(world, *particle, by);
        } else if (const auto figure = find_figure(world, impulse.target)) {
            strike(world.figures[*figure], by);
        }
        return impulse.target;
    }

    std::string operator()(const NoteEvent& note) const { return note.text; }

    std::string operator()(const RemoveEvent& removal) const {
        std::vector<ConstraintId> ids;
        for (const auto& name : removal.constraints)
            if (const auto id = find_constraint(world, name)) ids.push_back(*id);
        cut(world, std::span<const ConstraintId>(ids));
        return removal.constraints.empty() ? "" : removal.constraints.front();
    }

    std::string operator()(const SetEvent& set) const {
        const auto& to = set.changes;
        auto& settings = world.settings;
        if (auto* gravity = gravity_of(world); gravity && to.gravity)
            gravity->acceleration = to.gravity->template as<D, Real>();
        if (to.damping) (settings.mode == Mode::classic ? settings.classic.keep : settings.damping) = Real(*to.damping);
        if (to.bounce) settings.classic.bounce = Real(*to.bounce);
        for (auto& plane : world.bounds) {
            if (to.bounce) plane.restitution = Real(*to.bounce);
            if (to.friction) plane.friction = Real(*to.friction);
        }
        if (to.time_scale) settings.classic.time_scale = Real(*to.time_scale);
        if (to.substeps) settings.substeps = *to.substeps;
        if (to.iterations) settings.iterations = *to.iterations;
        if (to.passes) settings.classic.passes = *to.passes;
        return "";
    }

  private:
    /// Applies an impulse to a figure as one body: every movable particle gets the same change of velocity.
    void strike(const Figure& figure, const Vec<D, Real>& by) const {
        Real mass = 0;
        for (const auto id : figure.particles)
            if (const auto row = row_of(world, id)) mass += inverse_or_zero(world.particles.mobility[*row]);
        for (const auto id : figure.particles)
            if (const auto row = row_of(world, id); row && world.particles.mobility[*row] > Real(0))
                set_velocity(world, id, world.particles.velocity[*row] + by * inverse_or_zero(mass));
    }
};

} // namespace sinew

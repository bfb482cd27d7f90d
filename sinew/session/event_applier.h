#pragma once

#include "sinew/constraint/kind_table.h"
#include "sinew/math/random.h"
#include "sinew/scene/colliders.h"
#include "sinew/scene/join.h"
#include "sinew/scene/scene.h"
#include "sinew/topology/cut.h"
#include "sinew/world/colliders.h"
#include "sinew/world/edit.h"
#include "sinew/world/environment.h"

namespace sinew {

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
    /// Only for the log: Steering reads the scene's events by their times.
    std::string operator()(const SteerEvent& steer) const { return steer.figure; }

    std::string operator()(const RemoveEvent& removal) const {
        std::vector<ConstraintId> ids;
        for (const auto& name : removal.names) {
            for (const auto& id : find_constraints(world, name)) ids.push_back(id);
            if (name.find('/') != std::string::npos) continue;
            if (const auto figure = find_figure(world, name)) remove_figure(world, *figure);
            while (const auto collider = collider_called(world, name)) remove_collider(world, *collider);
        }
        cut(world, std::span<const ConstraintId>(ids));
        return removal.names.empty() ? "" : removal.names.front();
    }

    std::string operator()(const ColliderEvent& change) const {
        for (auto& collider : world.colliders) {
            if (collider.name != change.collider || collider.tag >= scene.colliders.size()) continue;
            const auto& section = scene.colliders[collider.tag];
            if (change.enabled)
                collider.filter = *change.enabled ? filter_of(section.layers, section.touches) : collide::Filter{0, 0};
            if (change.surface_velocity) collider.surface_velocity = change.surface_velocity->template as<D, Real>();
        }
        return change.collider;
    }

    std::string operator()(const AdjustEvent& event) const {
        for (const auto& name : event.constraints)
            for (const auto& id : find_constraints(world, name)) adjust(id, event);
        return event.constraints.empty() ? "" : event.constraints.front();
    }

    std::string operator()(const ResizeEvent& event) const {
        for (const auto id : find_particles(world, event.particles)) set_radius(world, id, Real(event.radius));
        return event.particles;
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
    void adjust(const ConstraintId& id, const AdjustEvent& to) const {
        constexpr Real never = limit::measure<Real>;
        const auto unless_zero = [](double value) { return value > 0 ? Real(value) : never; };
        if (to.rest || to.low || to.high) set_limits(world, id, limits_after(id, to));
        if (to.compliance) set_compliance(world, id, Real(*to.compliance));
        if (to.max_force) set_max_force(world, id, unless_zero(*to.max_force));
        if (to.breaking_strain) set_breaking_strain(world, id, unless_zero(*to.breaking_strain));
        if (to.break_force) set_break_force(world, id, unless_zero(*to.break_force));
    }

    /// Limits of a constraint after an event: a limit that the event leaves out stays, unless the other one passes it.
    Interval<Real> limits_after(const ConstraintId& id, const AdjustEvent& to) const {
        Interval<Real> limits{};
        visit_table(world, id.kind, [&](const auto& table) {
            if (const auto row = table.handles.find(id.id)) limits = {table.low(*row), table.high(*row)};
        });
        const auto& kind = kinds_in<D>[std::size_t(id.kind)];
        const auto value = [&](double in_file) { return Real(in_file) * (kind.angle ? pi<Real> / 180 : Real(1)); };
        if (to.rest) return exactly(value(*to.rest));
        if (to.low) limits.low = value(*to.low), limits.high = max(limits.high, limits.low);
        if (to.high) limits.high = value(*to.high), limits.low = min(limits.low, limits.high);
        return limits;
    }

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

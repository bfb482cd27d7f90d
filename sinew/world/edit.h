#pragma once

#include "sinew/world/world.h"

#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Changes of a world between steps.
///
/// Ids are valid until their row is removed, in the world that handed the id out and in its copies. Given any other id
/// (stale, of another world, of a future undone by going back to a snapshot, or made up) a function does nothing and
/// returns false, nothing or 0. Ids mean nothing to another process: to repeat a change there, keep rows or names.
///
/// Finite numbers beyond the stated limits (world.h) are clamped. Non-finite vectors are stored unchanged: the next
/// step quarantines the figure.
namespace sinew {

template <int D, class Real> struct ParticleSpec {
    Vec<D, Real> position{};
    Vec<D, Real> velocity{};
    std::optional<Vec<D, Real>> previous{}; ///< instead of velocity: position one settings.frame ago
    Real mass = 1;                          ///< infinity: immovable
    Real radius = 0;
    FigureIndex figure = no_figure;
    Rolls rolls = Rolls::loose;
    Real inertia = Real(solid_inertia<D>); ///< as a share of mass times radius^2, 0.001 to 1000
    Vec<spins<D>, Real> spin{};            ///< angular velocity, counter-clockwise; 1 / time
};

/// Interval of a constraint's measure.
template <class Real> struct Interval { Real low, high; };
template <class Real> Interval<Real> exactly(Real value) {
    return {value, value};
}
template <class Real> Interval<Real> at_most(Real high) {
    return {-std::numeric_limits<Real>::infinity(), high};
}
template <class Real> Interval<Real> at_least(Real low) {
    return {low, std::numeric_limits<Real>::infinity()};
}
template <class Real> Interval<Real> between(Real low, Real high) {
    return {low, high};
}

template <class Real> struct ConstraintSpec {
    std::optional<Interval<Real>> limits{}; ///< nothing: the present measure, exactly
    Real compliance = 0;                    ///< 1 / stiffness (m/N for distances, rad/(N m) for angles); 0 is rigid
    Real relaxation = 1;                    ///< share of the error removed at once, (0, 1]
    Real split = Real(0.5);                 ///< share of the correction taken by the first member, [0, 1]
    Real max_force = std::numeric_limits<Real>::infinity(); ///< largest force, newtons (N m for angles)
    Real damping_time = 0; ///< damping time of a compliant constraint, seconds: force = k (C + damping_time dC/dt)
    Real breaking_strain = std::numeric_limits<Real>::infinity();
    Real break_force = std::numeric_limits<Real>::infinity(); ///< newtons (N m for angles) borne without tearing
    Real damage_limit = 0; ///< damage limit: excess strain times time borne before tearing
    FigureIndex figure = no_figure;
};

template <class To, class From> Interval<To> cast(const Interval<From>& limits) {
    return {To(limits.low), To(limits.high)};
}
template <class To, class From> ConstraintSpec<To> cast(const ConstraintSpec<From>& spec) {
    return {.limits = spec.limits ? std::optional(cast<To>(*spec.limits)) : std::nullopt,
            .compliance = To(spec.compliance),
            .relaxation = To(spec.relaxation),
            .split = To(spec.split),
            .max_force = To(spec.max_force),
            .damping_time = To(spec.damping_time),
            .breaking_strain = To(spec.breaking_strain),
            .break_force = To(spec.break_force),
            .damage_limit = To(spec.damage_limit),
            .figure = spec.figure};
}

template <int D, class Real> struct PinSpec {
    std::optional<Vec<D, Real>> target{}; ///< nothing: the particle's position; otherwise approached in the next step
    Real compliance = 0;
    Real damping = 1;
    Real max_force = 0;
    Hold hold = Hold::fixed;
    Vec<D, Real> steer{};
    Real steer_damping = 0;
};

/// Spec of a pin like this one.
template <int D, class Real> PinSpec<D, Real> spec_of(const Pin<D, Real>& pin) {
    return {.target = pin.target,
            .compliance = pin.compliance,
            .damping = pin.damping,
            .max_force = pin.max_force,
            .hold = pin.hold,
            .steer = pin.steer,
            .steer_damping = pin.steer_damping};
}

struct Sizes {
    std::size_t particles = 0, constraints = 0;
};

/// Reserves memory for more rows, to avoid reallocation. `constraints` counts distances.
template <int D, class Real> void reserve(World<D, Real>& world, Sizes sizes);

template <int D, class Real> ParticleId add_particle(World<D, Real>& world, const ParticleSpec<D, Real>& spec);

/// Removes particles, their constraints and their pins, in one pass over the world. Returns the number of particles
/// removed.
template <int D, class Real> std::size_t remove_particles(World<D, Real>& world, std::span<const ParticleId> ids);

/// Adds a constraint of the kind numbered `kind` over `members`. Returns nothing if a member is gone or named twice, if
/// the number of members is not the kind's, or if the limits are impossible: a length is never negative, nor, in
/// 3D, an angle.
template <int D, class Real>
std::optional<ConstraintId> add_constraint(World<D, Real>& world, int kind, std::span<const ParticleId> members,
                                           const ConstraintSpec<Real>& spec);

/// Distance of at most 2 between two particles: add<Distance>(world, {a, b}, {.limits = at_most(2.0)}).
template <template <int> class Kind, int D, class Real>
std::optional<ConstraintId> add(World<D, Real>& world, std::initializer_list<ParticleId> members,
                                const ConstraintSpec<Real>& spec = {}) {
    return add_constraint(world, kind_number<Kind, D>, std::span(members.begin(), members.size()), spec);
}

/// Adds many distances of one spec, in a fraction of the time of as many calls of add_constraint. Appends their ids to
/// `added`; pairs whose ends are gone or equal are skipped, and all of them where the limits are impossible.
template <int D, class Real>
void add_distances(World<D, Real>& world, std::span<const std::array<ParticleId, 2>> ends,
                   const ConstraintSpec<Real>& spec, IdList<ConstraintId>& added);

/// Returns the number of constraints removed.
template <int D, class Real> std::size_t remove_constraints(World<D, Real>& world, std::span<const ConstraintId> ids);

/// Moves the limits of a constraint at a rate (m/s, rad/s): a winch, a motor. Under a load beyond max_force the limits
/// slip: they never run ahead of the measure, so a stalled motor stores nothing. False for an unknown id, a NaN rate,
/// or a motor of unlimited force beside a rigid limit on the same particles, which nothing could satisfy.
template <int D, class Real> bool drive(World<D, Real>& world, const ConstraintId& id, Real rate);
/// Changes max_force: a motor tires. 0 releases the constraint. False for an unknown id or a NaN force.
template <int D, class Real> bool set_max_force(World<D, Real>& world, const ConstraintId& id, Real max_force);
/// Change the limits of a constraint, its compliance, or what it bears before it tears; infinity: it never tears. False
/// for an unknown id, a NaN, or limits that no constraint of the kind can have.
template <int D, class Real>
bool set_limits(World<D, Real>& world, const ConstraintId& id, const Interval<Real>& limits);
template <int D, class Real> bool set_compliance(World<D, Real>& world, const ConstraintId& id, Real compliance);
template <int D, class Real> bool set_breaking_strain(World<D, Real>& world, const ConstraintId& id, Real strain);
template <int D, class Real> bool set_break_force(World<D, Real>& world, const ConstraintId& id, Real force);

/// Measure and load of a constraint.
struct ConstraintState {
    double measure = 0; ///< in the kind's unit: length, radians, area, volume
    double error = 0;   ///< distance outside the limits; negative below the lower limit
    double strain = 0;  ///< error / violated limit; for angles the error itself
    double tension = 0; ///< force in the last substep, newtons; positive when pulling
};
template <int D, class Real>
std::optional<ConstraintState> constraint_state(const World<D, Real>& world, const ConstraintId& id);

template <int D, class Real> std::optional<Row> row_of(const World<D, Real>& world, ParticleId id) {
    return world.particles.handles.find(id);
}
template <int D, class Real> std::optional<Vec<D, Real>> position_of(const World<D, Real>& world, ParticleId id);
template <int D, class Real> std::optional<Vec<D, Real>> velocity_of(const World<D, Real>& world, ParticleId id);

/// Moves a particle; the velocity is unchanged.
template <int D, class Real> bool set_position(World<D, Real>& world, ParticleId id, const Vec<D, Real>& position);
template <int D, class Real> bool set_velocity(World<D, Real>& world, ParticleId id, const Vec<D, Real>& velocity);
/// Angular velocity of a particle that rolls (Rolls), counter-clockwise; 1 / time. False if it is not finite.
template <int D, class Real> bool set_spin(World<D, Real>& world, ParticleId id, const Vec<spins<D>, Real>& spin);
template <int D, class Real> bool set_mass(World<D, Real>& world, ParticleId id, Real mass);
/// Changes the collision radius. False for an unknown id or a NaN.
template <int D, class Real> bool set_radius(World<D, Real>& world, ParticleId id, Real radius);

/// Adds a force, newtons, for the next step; calls accumulate.
template <int D, class Real> bool apply_force(World<D, Real>& world, ParticleId id, const Vec<D, Real>& force);
/// Changes the momentum at once, newton seconds.
template <int D, class Real> bool apply_impulse(World<D, Real>& world, ParticleId id, const Vec<D, Real>& impulse);

/// Pins a particle. A particle that a rigid pin holds already is taken over: that pin is removed. Pins that are springs
/// or have a maximum force act side by side.
template <int D, class Real>
std::optional<PinId> pin(World<D, Real>& world, ParticleId particle, const PinSpec<D, Real>& spec = {});
/// Target of the pin at the end of the next step, approached in a straight line.
template <int D, class Real> bool move_pin(World<D, Real>& world, PinId pin, const Vec<D, Real>& target);
/// Removes a pin; the particle keeps the velocity of the motion with the pin.
template <int D, class Real> bool unpin(World<D, Real>& world, PinId pin);
/// Removes every pin of a particle; returns their number.
template <int D, class Real> std::size_t unpin_all(World<D, Real>& world, ParticleId particle);

/// Adds a figure at the lowest free index.
template <int D, class Real>
FigureIndex add_figure(World<D, Real>& world, std::string_view name, std::string_view prefab = "");

/// Handle of a figure, for callers which may outlive the figure; Id{} for an unused index.
template <int D, class Real> FigureId figure_id(const World<D, Real>& world, FigureIndex figure);
/// Index of a living figure, nothing once removed.
template <int D, class Real>
std::optional<FigureIndex> figure_index(const World<D, Real>& world, const FigureId& figure);

/// Removes a figure with all particles, their constraints and pins, the figure's constraints between other particles,
/// names and drawn pieces. Other figures keep their indices; the freed index goes to the next figure added. False for
/// an unknown figure.
template <int D, class Real> bool remove_figure(World<D, Real>& world, FigureIndex figure);
template <int D, class Real> bool remove_figure(World<D, Real>& world, const FigureId& figure) {
    const auto index = figure_index(world, figure);
    return index && remove_figure(world, *index);
}

enum class Momentum : bool { keep, reset };
/// Translates a figure with its pins at once, without collisions or forces on the way. False for an unknown figure.
template <int D, class Real>
bool teleport(World<D, Real>& world, FigureIndex figure, const Vec<D, Real>& offset,
              Momentum momentum = Momentum::keep);

/// Releases a quarantined figure; the particles start at rest where they were frozen. False for an unknown figure.
template <int D, class Real> bool release_quarantine(World<D, Real>& world, FigureIndex figure);

/// Particle called "figure/name", or nothing.
template <int D, class Real>
std::optional<ParticleId> find_particle(const World<D, Real>& world, std::string_view path);
/// Particles of a path: one, or with a trailing star every particle of the figure with that prefix, in the order of
/// construction: "bridge/joint_*". Empty if there is none.
template <int D, class Real> std::vector<ParticleId> find_particles(const World<D, Real>& world, std::string_view path);
/// Constraints of a path, likewise: "rope/link_*".
template <int D, class Real>
std::vector<ConstraintId> find_constraints(const World<D, Real>& world, std::string_view path);
template <int D, class Real>
std::optional<ConstraintId> find_constraint(const World<D, Real>& world, std::string_view path);
template <int D, class Real> std::optional<FigureIndex> find_figure(const World<D, Real>& world, std::string_view name);

} // namespace sinew

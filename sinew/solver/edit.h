#pragma once

#include "sinew/solver/world.h"

#include <array>
#include <initializer_list>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

/// Everything that changes a world between steps.
///
/// Ids stay good until the row they name is removed, in the world that handed them out and in its copies. A function
/// given any other id (stale, of another world, from a future that going back to a snapshot undid, or made up) does
/// nothing and says so by returning false, nothing or 0. An id says nothing to another process: to do the same again
/// there, keep rows or names.
///
/// Finite numbers beyond the stated limits (world.h) are held at them. A vector that is not finite is taken as it is:
/// the next step puts its figure in quarantine.
namespace sinew {

template <int D, class Real> struct ParticleSpec {
    Vec<D, Real> position{};
    Vec<D, Real> velocity{};
    std::optional<Vec<D, Real>> previous{}; ///< instead of velocity: where it was one settings.frame ago
    Real mass = 1;                          ///< infinity: nothing moves it
    Real radius = 0;
    FigureIndex figure = no_figure;
};

/// The interval a constraint's measure is held in.
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
    std::optional<Interval<Real>> limits{}; ///< nothing: exactly what it measures now
    Real compliance = 0;                    ///< 1/stiffness (m/N for distances, rad/(N m) for angles); 0 is rigid
    Real relaxation = 1;                    ///< share of the error removed at once, (0, 1]
    Real split = Real(0.5);                 ///< share of the correction the first member takes
    Real max_force = std::numeric_limits<Real>::infinity(); ///< most it pulls or pushes with, newtons (N m for angles)
    Real lead = 0; ///< a compliant one aims where the measure will be so much later, in seconds: a damper
    Real breaking_strain = std::numeric_limits<Real>::infinity();
    Real toughness = 0; ///< strain beyond the breaking strain, times time, that it bears before it tears
    FigureIndex figure = no_figure;
};

template <int D, class Real> struct PinSpec {
    std::optional<Vec<D, Real>> target{}; ///< nothing: where the particle is; else the next step carries it there
    Real compliance = 0;
    Real damping = 1;
    Real max_force = 0;
    Hold hold = Hold::fixed;
    Vec<D, Real> steer{};
    Real steer_damping = 0;
};

struct Sizes {
    std::size_t particles = 0, constraints = 0;
};

/// Room for this many more, so that adding them moves nothing. `constraints` counts distances.
template <int D, class Real> void reserve(World<D, Real>& world, Sizes sizes);

template <int D, class Real> ParticleId add_particle(World<D, Real>& world, const ParticleSpec<D, Real>& spec);

/// Removes particles, the constraints they were part of and their pins. One pass over the world however many are given.
/// Returns how many there were.
template <int D, class Real> std::size_t remove_particles(World<D, Real>& world, std::span<const ParticleId> ids);

/// Adds a constraint of the kind numbered `kind` over `members`; nothing is added if a member is gone, named twice or
/// the number of members is not the kind's.
template <int D, class Real>
std::optional<ConstraintId> add_constraint(World<D, Real>& world, int kind, std::span<const ParticleId> members,
                                           const ConstraintSpec<Real>& spec);

/// add<Distance>(world, {a, b}, {.limits = at_most(2.0)}): a rope of two particles.
template <template <int> class Kind, int D, class Real>
std::optional<ConstraintId> add(World<D, Real>& world, std::initializer_list<ParticleId> members,
                                const ConstraintSpec<Real>& spec = {}) {
    return add_constraint(world, kind_number<Kind, D>, std::span(members.begin(), members.size()), spec);
}

/// As many distances, all of one spec, as calls of add_constraint would add, in a fraction of their time. Their ids
/// come behind those in `added`; ends that are gone or the same make none.
template <int D, class Real>
void add_distances(World<D, Real>& world, std::span<const std::array<ParticleId, 2>> ends,
                   const ConstraintSpec<Real>& spec, IdList<ConstraintId>& added);

/// Returns how many there were.
template <int D, class Real> std::size_t remove_constraints(World<D, Real>& world, std::span<const ConstraintId> ids);

/// From now on its limits move at this rate (m/s, rad/s): a winch, a motor. Where the load is more than its max_force
/// it slips: limits of lengths never run ahead of what they measure. False for a rate that is no number.
template <int D, class Real> bool drive(World<D, Real>& world, const ConstraintId& id, Real rate);
/// Another max_force: a motor that tires. 0 lets go.
template <int D, class Real> bool set_max_force(World<D, Real>& world, const ConstraintId& id, Real max_force);

/// What a constraint measures and how hard it works.
struct ConstraintState {
    double measure = 0; ///< in the kind's unit: length, radians, area, volume
    double error = 0;   ///< how far outside its limits; negative below the lower
    double strain = 0;  ///< error over the limit it broke; for angles the error itself
    double tension = 0; ///< of the last substep, in newtons; positive where it pulls
};
template <int D, class Real>
std::optional<ConstraintState> constraint_state(const World<D, Real>& world, const ConstraintId& id);

template <int D, class Real> std::optional<Row> row_of(const World<D, Real>& world, ParticleId id) {
    return world.particles.slots.find(id);
}
template <int D, class Real> std::optional<Vec<D, Real>> position_of(const World<D, Real>& world, ParticleId id);
template <int D, class Real> std::optional<Vec<D, Real>> velocity_of(const World<D, Real>& world, ParticleId id);

/// Puts a particle somewhere else without giving it speed.
template <int D, class Real> bool set_position(World<D, Real>& world, ParticleId id, const Vec<D, Real>& position);
template <int D, class Real> bool set_velocity(World<D, Real>& world, ParticleId id, const Vec<D, Real>& velocity);
template <int D, class Real> bool set_mass(World<D, Real>& world, ParticleId id, Real mass);

/// A force (newtons) that acts during the next step; further calls add up.
template <int D, class Real> bool apply_force(World<D, Real>& world, ParticleId id, const Vec<D, Real>& force);
/// A change of momentum (newton seconds), at once.
template <int D, class Real> bool apply_impulse(World<D, Real>& world, ParticleId id, const Vec<D, Real>& impulse);

template <int D, class Real>
std::optional<PinId> pin(World<D, Real>& world, ParticleId particle, const PinSpec<D, Real>& spec = {});
/// Where the pin's target shall be at the end of the next step; it goes there in a straight line.
template <int D, class Real> bool move_pin(World<D, Real>& world, PinId pin, const Vec<D, Real>& target);
/// Lets go: the particle keeps the velocity it was carried with.
template <int D, class Real> bool unpin(World<D, Real>& world, PinId pin);
/// Takes every pin off a particle; returns how many there were.
template <int D, class Real> std::size_t unpin_all(World<D, Real>& world, ParticleId particle);

/// The figure gets the lowest index that is free.
template <int D, class Real>
FigureIndex add_figure(World<D, Real>& world, std::string_view name, std::string_view prefab = "");

/// A figure's handle, to keep for longer than the figure may live; Id{} if there is none of that index.
template <int D, class Real> FigureId figure_id(const World<D, Real>& world, FigureIndex figure);
/// Its index now; nothing once it was removed.
template <int D, class Real>
std::optional<FigureIndex> figure_index(const World<D, Real>& world, const FigureId& figure);

/// Removes a figure and all that belongs to it: particles, their constraints and pins, constraints of its own between
/// others, names, and drawn pieces. Other figures keep their indices; the free one is given to the next figure that is
/// added. False if there is none.
template <int D, class Real> bool remove_figure(World<D, Real>& world, FigureIndex figure);
template <int D, class Real> bool remove_figure(World<D, Real>& world, const FigureId& figure) {
    const auto index = figure_index(world, figure);
    return index && remove_figure(world, *index);
}

enum class Momentum : bool { keep, reset };
/// Moves a whole figure at once, its pins with it; nothing is swept, struck or pulled on the way. False if there is
/// none.
template <int D, class Real>
bool teleport(World<D, Real>& world, FigureIndex figure, const Vec<D, Real>& offset,
              Momentum momentum = Momentum::keep);

/// Lets a quarantined figure move again; its particles keep their place and lose their speed. False if there is none.
template <int D, class Real> bool release_quarantine(World<D, Real>& world, FigureIndex figure);

/// The particle called "figure/name", or nothing.
template <int D, class Real>
std::optional<ParticleId> find_particle(const World<D, Real>& world, std::string_view path);
/// The particle of that path; or, where it ends in a star, all of the figure whose names begin so, in the order they
/// were built: "bridge/joint_*". Empty if there is none.
template <int D, class Real> std::vector<ParticleId> find_particles(const World<D, Real>& world, std::string_view path);
template <int D, class Real>
std::optional<ConstraintId> find_constraint(const World<D, Real>& world, std::string_view path);
template <int D, class Real> std::optional<FigureIndex> find_figure(const World<D, Real>& world, std::string_view name);

} // namespace sinew

#pragma once

#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

/// Phases of a step, each in a separate file.
namespace sinew {

/// Largest acceleration, m/s^2: the largest force on the lightest particle.
template <class Real> constexpr Real largest_acceleration = limit::force<Real>* limit::mass<Real>;

/// sweep/forces.cpp: forces on a particle, at the present position or another: dv/dt = acceleration - drag_rate v.
template <int D, class Real> struct Forcing {
    Vec<D, Real> acceleration{};
    Real drag_rate = 0;
};
template <int D, class Real>
Forcing<D, Real> forcing_on(const World<D, Real>& world, Row row, const Vec<D, Real>& position);
template <int D, class Real> Forcing<D, Real> forcing_on(const World<D, Real>& world, Row row) {
    return forcing_on(world, row, world.particles.position[row]);
}

/// sweep/forces.cpp: hands out the forces that strike one particle a step, into particles.force.
template <int D, class Real> void apply_random_pushes(World<D, Real>& world);
/// step/wind.cpp: finds the areas, lines and balls that winds press on; adds the pressure, into particles.force.
template <int D, class Real> void find_wind_areas(World<D, Real>& world, Solver<D, Real>& solver);
template <int D, class Real> void apply_winds(World<D, Real>& world, Solver<D, Real>& solver, Real dt);
/// Zeroes particles.force, which acts during one step.
template <int D, class Real> void forget_forces(World<D, Real>& world);

/// quarantine.cpp: freezes figures and loose particles that are not finite, at their last finite positions; clamps
/// finite values to the stated limits. Saves the positions before the step.
template <int D, class Real> void hold_in_limits(World<D, Real>& world, Solver<D, Real>& solver);

/// tear.cpp: removes constraints strained beyond their breaking point for longer than permitted, or loaded beyond their
/// break force, after a step of dt; a
/// torn distance takes along the constraints that both ends belong to.
template <int D, class Real> void tear(World<D, Real>& world, Solver<D, Real>& solver, Real dt);

/// sweep/gather.cpp: sets the constants of a sweep in substeps of length h; gathers the particles of slots [first,
/// last) into columns, and scatters them back.
template <int D, class Real> void begin_sweep(World<D, Real>& world, Solver<D, Real>& solver, Real h);
template <int D, class Real> void gather(World<D, Real>& world, Solver<D, Real>& solver, Real h, Row first, Row last);
template <int D, class Real> void scatter(World<D, Real>& world, Solver<D, Real>& solver, Row first, Row last);

/// sweep/rolling.cpp: while a world is prepared, lists the particles that roll; before a sweep in substeps of length h,
/// their turns; after it, the turns of a step of dt.
template <int D, class Real> void find_rollers(World<D, Real>& world, Solver<D, Real>& solver);
template <int D, class Real> void begin_rolling(World<D, Real>& world, Solver<D, Real>& solver, Real h);
template <int D, class Real> void end_rolling(World<D, Real>& world, Solver<D, Real>& solver, Real dt);

/// direct/find_blocks.cpp: finds the components to be solved directly, where the world has changed; true if all of it
/// was searched.
template <int D, class Real> bool find_blocks(World<D, Real>& world, Solver<D, Real>& solver);

/// plan.cpp: plans the sweep of everything outside the blocks; entirely if `anew`, otherwise the changed parts.
template <int D, class Real> void make_plan(World<D, Real>& world, Solver<D, Real>& solver, bool anew);

/// direct/step_blocks.cpp: moves every block over a step; tensions are reported as multipliers of a substep of the
/// given length.
template <int D, class Real> void step_blocks(World<D, Real>& world, Solver<D, Real>& solver, Real dt, Real substep);

/// ports/find_ports.cpp: finds the ports between blocks and sweep; after planning, finds the swept constraints at
/// ports, and sets the load tethers.
template <int D, class Real> void find_ports(World<D, Real>& world, Solver<D, Real>& solver);
template <int D, class Real> void tie_ports(World<D, Real>& world, Solver<D, Real>& solver);

/// free_bodies.cpp: after planning, finds bodies that nothing holds.
template <int D, class Real> void find_free_bodies(World<D, Real>& world, Solver<D, Real>& solver);

/// drive.cpp: finds out if any limit is driven or has a maximum force; advances driven limits; shifts the limits of
/// lengths loaded up to the maximum force.
template <int D, class Real> bool any_driven(const World<D, Real>& world);
template <int D, class Real> void move_limits(World<D, Real>& world, Real h);
template <int D, class Real> void slip(World<D, Real>& world, Solver<D, Real>& solver, Real h);

/// contact/touches.cpp: makes room for the touches of a step, and ends a step: touches become events, colliders arrive
/// at their targets.
template <int D, class Real> void begin_touches(World<D, Real>& world, Solver<D, Real>& solver);
template <int D, class Real> void end_touches(World<D, Real>& world, Solver<D, Real>& solver);

/// sleep.cpp: before a step, wakes the islands that something may touch, that are moved, or all after an edit; after
/// it, puts islands to sleep that have been at rest for long enough, and notes the parameters with which they sleep.
template <int D, class Real> void wake(World<D, Real>& world, Solver<D, Real>& solver, Real dt);
template <int D, class Real> void fall_asleep(World<D, Real>& world, Solver<D, Real>& solver, Real dt);
template <int D, class Real> void note_sleep_parameters(World<D, Real>& world);

/// energy_bound.cpp: while a world is prepared, makes room; notes the state before a step; after it, takes back the
/// energy that islands have gained.
template <int D, class Real> void make_energy_room(World<D, Real>& world, Solver<D, Real>& solver);
template <int D, class Real> void note_energy(World<D, Real>& world, Solver<D, Real>& solver);
template <int D, class Real> void bound_energy(World<D, Real>& world, Solver<D, Real>& solver, Real dt);

/// internal_damping.cpp: before a step of physical mode, damps the motion inside figures that have internal damping.
template <int D, class Real> void damp_internally(World<D, Real>& world, Solver<D, Real>& solver, Real dt);

/// alone.cpp: before a step, finds the bodies that are far from everything they may touch; while a world is prepared,
/// lists its bodies; within a step, whether the body of a particle that is near may touch something.
template <int D, class Real> void find_alone(World<D, Real>& world, Solver<D, Real>& solver, Real dt);
template <int D, class Real> void list_bodies(World<D, Real>& world, Solver<D, Real>& solver);
template <int D, class Real> bool meets_others(const Solver<D, Real>& solver, Row row);

/// classic.cpp: a step by the originals' rules.
template <int D, class Real> void classic_step(World<D, Real>& world, Solver<D, Real>& solver, Real dt);

} // namespace sinew

#pragma once

#include "sinew/solver/world.h"

/// The parts of a step that both modes share, each in a file of its own.
namespace sinew {

/// Nothing is pushed harder: the largest force on the lightest particle.
template <class Real> constexpr Real largest_acceleration = limit::force<Real>* limit::mass<Real>;

/// force.cpp: what acts on a particle, where it is or at another place: a velocity v changes by acceleration -
/// drag_rate v.
template <int D, class Real> struct Push {
    Vec<D, Real> acceleration{};
    Real drag_rate = 0;
};
template <int D, class Real> Push<D, Real> push_on(const World<D, Real>& world, Row row, const Vec<D, Real>& place);
template <int D, class Real> Push<D, Real> push_on(const World<D, Real>& world, Row row) {
    return push_on(world, row, world.particles.position[row]);
}

/// force.cpp: hands out the forces that strike one particle a step, into particles.force.
template <int D, class Real> void apply_random_pushes(World<D, Real>& world);

/// quarantine.cpp: figures and loose particles that are not finite stand still from now on, where they last were; what
/// is finite but beyond the stated limits is held at them. And it notes where they were before the step.
template <int D, class Real> void hold_in_limits(World<D, Real>& world);

/// tear.cpp: removes constraints strained beyond their breaking point for longer than they bear, after a step of dt;
/// with a distance goes what both of its ends belong to.
template <int D, class Real> void tear(World<D, Real>& world, Real dt);

/// swept.cpp: what holds for all particles of the sweep in substeps of length h; those of slots [first, last) into
/// their columns, and back.
template <int D, class Real> void begin_sweep(World<D, Real>& world, Real h);
template <int D, class Real> void take_up(World<D, Real>& world, Real h, Row first, Row last);
template <int D, class Real> void put_back(World<D, Real>& world, Row first, Row last);

/// plan.cpp: works out how the sweep goes about what is in no block; anew, or what has changed of it.
template <int D, class Real> void make_plan(World<D, Real>& world, bool anew);

/// block_step.cpp: moves every block over a step; tensions are told as multipliers of a substep of that length.
template <int D, class Real> void step_blocks(World<D, Real>& world, Real dt, Real substep);

/// ports/find_ports.cpp: where blocks are joined to what is swept; when the sweep is planned, which of its constraints
/// act there, and the load tethers.
template <int D, class Real> void find_ports(World<D, Real>& world);
template <int D, class Real> void tie_ports(World<D, Real>& world);

/// passive.cpp: limits of turns give a figure no energy. Finds the figures of which that can be said; notes their
/// energy before the constraints act; takes back what those added. Room for it is made before the step.
template <int D, class Real> void make_room_for_budgets(World<D, Real>& world);
template <int D, class Real> void find_passive(World<D, Real>& world);
template <int D, class Real> void note_energy(World<D, Real>& world);
template <int D, class Real> void take_back_gains(World<D, Real>& world, Real h);

/// drive.cpp: whether any limit is driven or gives way. Limits that are driven move on; lengths that were pulled harder
/// than they hold have slipped.
template <int D, class Real> bool any_driven(const World<D, Real>& world);
template <int D, class Real> void move_limits(World<D, Real>& world, Real h);
template <int D, class Real> void slip(World<D, Real>& world, Real h);

/// classic.cpp: a step by the originals' rules.
template <int D, class Real> void classic_step(World<D, Real>& world, Real dt);

} // namespace sinew

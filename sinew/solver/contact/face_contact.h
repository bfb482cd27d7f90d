#pragma once

#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

/// Contact of the faces of cloth with particles and links of other figures (face_contact.cpp), in three dimensions:
/// particles against faces, links against edges. Nothing crosses a face.
namespace sinew::detail {

/// After the prediction: makes the rows. `near_by`: gap at which rows begin, apart from the approach. `h`: length of
/// the substep.
template <int D, class Real>
void find_face_contacts(World<D, Real>& world, Solver<D, Real>& solver, Real near_by, Real h);
/// Among the passes over the links, and after them.
template <int D, class Real> void solve_face_contacts(Solver<D, Real>& solver, Real h);
/// Before positions advance: nothing crosses a face in the substep. True if a displacement has changed. `cuts_only`:
/// displacements only become shorter.
template <int D, class Real> bool guard_faces(World<D, Real>& world, Solver<D, Real>& solver, Real h, bool cuts_only);
/// The gaps after the displacements.
template <int D, class Real> void advance_face_contacts(Solver<D, Real>& solver, Real h);
/// After the particles have moved: velocities without the push out of overlaps.
template <int D, class Real> void relax_face_contacts(World<D, Real>& world, Solver<D, Real>& solver, Real h);

} // namespace sinew::detail

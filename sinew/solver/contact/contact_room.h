#pragma once

#include "sinew/collide/broadphase.h"
#include "sinew/solver/contact/cloth_room.h"
#include "sinew/solver/contact/contact_row.h"
#include "sinew/solver/contact/joint_rows.h"
#include "sinew/solver/contact/link_projector.h"
#include "sinew/solver/solver.h"

namespace sinew {

/// Contacts of colliding figures during a step: everything that follows from the rest of the world.
template <int D, class Real> struct ContactRoom {
    bool is_active = false;     ///< some figure collides
    bool is_stale = true;       ///< constraints or figures have changed since the last step
    std::vector<Row> particles; ///< rows of the particles of colliding figures
    std::vector<ContactSegment> segments;
    std::vector<char> by_rows;          ///< per slot of the sweep: held by rows of contact, not plane by plane
    std::vector<char> in_segment;       ///< per particle
    std::vector<char> is_exact;         ///< per slot of the sweep: links at the particle are exact, or there are none
    std::vector<char> exact_components; ///< per component of the plan: the sweep has no distances there
    std::vector<std::array<Row, 2>> links; ///< pairs of linked particles, in order

    collide::Broadphase<D, Real> broadphase;
    std::vector<collide::BoundingBox<D, Real>> boxes;
    std::vector<ContactCandidate> candidates;
    std::vector<Vec<D, Real>> expected, velocity; ///< per particle of `particles`: place and motion when listed
    Real listed_at = 0;                           ///< time since the list was made
    Real margin = 0;                              ///< deviation for which the list is valid, metres

    std::vector<ContactRow<D, Real>> rows;
    std::vector<KeptContact<D, Real>> spare;
    detail::LinkProjector<D, Real> projector;
    detail::JointRows<D, Real> joints;
    detail::ClothRoom<D, Real> cloth;

    /// Radius of a particle of cloth against everything; 0 for other particles.
    Real cover_of(Row row) const { return cloth.empty() ? Real(0) : cloth.cover[row]; }
    bool is_of_cloth(Row row) const { return cover_of(row) > Real(0); }
};

/// Work space of the contacts, made on demand.
template <int D, class Real> ContactRoom<D, Real>& contact_room(Solver<D, Real>& solver) {
    if (!solver.contacts) solver.contacts = std::make_shared<ContactRoom<D, Real>>();
    return *solver.contacts;
}

/// True if figures touch each other in this step.
template <int D, class Real> bool has_figure_contacts(const Solver<D, Real>& solver) {
    return solver.contacts && solver.contacts->is_active;
}

/// True if the links at a slot of the sweep are held exactly, apart from the sweep.
template <int D, class Real> bool is_held_exactly(const Solver<D, Real>& solver, Row slot) {
    return has_figure_contacts(solver) && solver.contacts->by_rows[slot] && solver.contacts->is_exact[slot];
}
/// True if no distance of a component of the plan is left to the sweep.
template <int D, class Real> bool is_held_exactly(const Solver<D, Real>& solver, const Component& component) {
    if (!has_figure_contacts(solver)) return false;
    const auto& is_swept = solver.contacts->projector.links().is_swept;
    for (Row slot = component.begin.slot; slot < solver.sweep_state.plan.end_of(component).slot; ++slot)
        if (!is_held_exactly(solver, slot) || is_swept[slot]) return false;
    return true;
}

/// contact_features.cpp: lists the features of the colliding figures, before a sweep.
template <int D, class Real> void find_contact_features(World<D, Real>& world, Solver<D, Real>& solver);
/// contact_features.cpp: lists the pairs of features that may touch, where the last list no longer holds; `left` is the
/// rest of the step, `h` a substep.
template <int D, class Real>
void find_contact_candidates(World<D, Real>& world, Solver<D, Real>& solver, Real left, Real h);

} // namespace sinew

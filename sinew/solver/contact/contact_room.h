#pragma once

#include "sinew/math/union_find.h"
#include "sinew/solver/cloth/thin_room.h"
#include "sinew/solver/contact/cloth_room.h"
#include "sinew/solver/contact/contact_list.h"
#include "sinew/solver/contact/contact_parts.h"
#include "sinew/solver/contact/contact_row.h"
#include "sinew/solver/contact/face_room.h"
#include "sinew/solver/contact/joint_rows.h"
#include "sinew/solver/contact/link_projector.h"
#include "sinew/solver/contact/polyhedron_room.h"
#include "sinew/solver/solver.h"

namespace sinew {

/// Contacts of colliding figures during a step: everything that follows from the rest of the world.
template <int D, class Real> struct ContactRoom {
    bool is_active = false;   ///< some figure collides
    bool all_by_rows = false; ///< rows of contact hold everything swept
    bool is_stale = true;     ///< constraints or figures have changed since the last step

    // Features.
    std::vector<ContactParticle<Real>> particles; ///< of colliding figures, in the order of rows
    std::vector<ContactSegment> segments;
    detail::PolyhedronRoom polyhedra;                         ///< in space
    std::vector<std::uint32_t> number_of;                     ///< per row: index in `particles`
    std::vector<std::uint32_t> first_segment_at, segments_at; ///< per particle: segments that begin there
    std::vector<char> by_rows;          ///< per slot of the sweep: held by rows of contact, not plane by plane
    std::vector<char> is_exact;         ///< per slot of the sweep: links at the particle are exact, or there are none
    std::vector<char> exact_components; ///< per component of the plan: the sweep has no distances there
    std::vector<char> cloth_components; ///< per component of the plan: some particle is of cloth
    std::vector<char> is_buried;        ///< per component of rigid links: it hangs on a particle behind a wall
    std::vector<std::array<Row, 2>> links; ///< pairs of linked particles, in order

    detail::ContactList<D, Real> list;                   ///< pairs of features that may touch
    std::vector<ContactMultiplier<D, Real>> multipliers; ///< per candidate of the list
    std::vector<KeptContact<D, Real>> kept_at_walls;     ///< in the order of their keys
    std::vector<KeptContact<D, Real>> written;           ///< copy of contacts kept by the world, after the last step
    detail::ContactParts<D, Real> parts;
    std::vector<ReboundRow<Real>> rebounds;                 ///< scratch
    DelassusRoom<D, Real> delassus;                         ///< scratch
    UnionFind groups;                                       ///< of bodies; scratch
    std::vector<IslandRow<D, Real>> island_rows, held_rows; ///< of a substep
    std::vector<IslandMasses<Real>> islands;                ///< by their first bodies
    std::vector<Vec<D, Real>> warm_from;                    ///< by slot: displacements before a warm start
    std::vector<Vec<spins<D>, Real>> rims_from;             ///< likewise, of balls and discs
    std::vector<WarmGain> warm_gains;                       ///< by body, then by the first of an island

    detail::LinkProjector<D, Real> projector;
    detail::JointRows<D, Real> joints;
    detail::ClothRoom<D, Real> cloth;
    detail::ThinRoom<D, Real> thin;
    detail::FaceRoom<D, Real> faces;

    /// A figure that hangs on a particle behind a wall may have no way out of it.
    bool is_buried_at(Row slot) const {
        const auto component = projector.links().component_of[slot];
        return component != detail::RigidLinks<D, Real>::none && is_buried[component] != 0;
    }
    /// True for the number of a solid in space.
    bool is_solid(std::uint32_t feature) const { return feature >= particles.size() + segments.size(); }
    const detail::SolidParts& solid(std::uint32_t feature) const {
        return polyhedra.solids[feature - particles.size() - segments.size()];
    }
    std::uint32_t first_corner_of(std::uint32_t feature) const {
        return polyhedra.lead(std::uint32_t(feature - particles.size() - segments.size()));
    }
    bool is_of_cloth(Row row) const { return !cloth.empty() && cloth.is_cloth[row]; }
};

/// Work space of the contacts, made on demand.
template <int D, class Real> ContactRoom<D, Real>& contact_room(Solver<D, Real>& solver) {
    if (!solver.contacts) solver.contacts = std::make_shared<ContactRoom<D, Real>>();
    return *solver.contacts;
}

/// Part in which a pair of features is solved.
template <int D, class Real> std::uint32_t part_of(const ContactRoom<D, Real>& room, const ContactCandidate& pair) {
    std::uint32_t low = ~std::uint32_t(0), high = 0;
    const auto include = [&](std::uint32_t particle) {
        const auto strip = room.particles[particle].strip;
        low = std::min(low, strip), high = std::max(high, strip);
    };
    const auto count = room.particles.size();
    for (const auto feature : {pair.first, pair.second})
        if (feature < count)
            include(feature);
        else if (feature - count < room.segments.size())
            include(room.segments[feature - count].number_a), include(room.segments[feature - count].number_b);
        else // with all its corners
            include(room.first_corner_of(feature));
    return detail::ContactParts<D, Real>::part_of(low, high);
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
/// contact_candidates.cpp: lists the solids that overlap, at the start of a step.
template <int D, class Real> void find_nested_solids(World<D, Real>& world, Solver<D, Real>& solver);
/// contact_candidates.cpp: lists the pairs of features that may touch, where the last list no longer holds; `left` is
/// the rest of the step, `h` a substep. True if the list is new.
template <int D, class Real>
bool find_contact_candidates(World<D, Real>& world, Solver<D, Real>& solver, Real left, Real h);
/// Lists the particles of each part that may touch a plane of the world while the list of pairs is valid; `margin`:
/// distance from which walls are looked at, apart from the radius. Unless `all`, after a renewal only its particles are
/// looked at.
template <int D, class Real>
void find_near_planes(const World<D, Real>& world, ContactRoom<D, Real>& room, Real margin, bool all);

} // namespace sinew

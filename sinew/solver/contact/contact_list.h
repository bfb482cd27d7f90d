#pragma once

#include "sinew/solver/contact/contact_row.h"
#include "sinew/solver/contact/feature_grid.h"
#include "sinew/solver/contact/polyhedron_room.h"

#include <algorithm>
#include <array>
#include <vector>

namespace sinew::detail {

/// Box around a solid, named by its first segment.
template <int D, class Real> struct SolidBox {
    collide::BoundingBox<D, Real> box;
    std::uint32_t solid = 0;
};

/// Pairs of features that may touch, and the motion for which the list is valid: nothing deviates by more than a margin
/// from its expected place. What does is given a new forecast, and its pairs are searched for again. Every row that may
/// act is then among the candidates, so results do not depend on when the list was made.
template <int D, class Real> struct ContactList {
    using Vector = Vec<D, Real>;
    std::vector<ContactCandidate> candidates;          ///< by parts, each in ascending order
    std::vector<std::uint32_t> near_p, near_a, near_b; ///< per candidate: slots of a particle and a segment's ends
    std::vector<Real> near_size; ///< per candidate: distance at which they may touch, without the approach

    bool is_valid = false;
    Real margin = 0;                        ///< deviation for which the list is valid, metres
    Real near_by = 0;                       ///< gap at which rows begin, apart from the approach, metres
    Real h = 0, horizon = 0, age = 0;       ///< substep; duration of the expected motion, and since the list was made
    Real widest = 0;                        ///< largest radius
    std::vector<Vector> position, velocity; ///< per particle, when its forecast was made
    std::vector<Real> born;                 ///< per particle: age of the list when its forecast was made
    Vector mean{};                          ///< mean velocity, when listed: the grids move with it
    bool follows_last = false;              ///< the numbers of features are those of the last list
    bool was_renewed = false;               ///< the last change was a renewal
    std::vector<std::uint32_t> renewed, astray; ///< particles renewed since the list was made, and in this substep
    std::vector<std::uint32_t> renewed_segments, astray_segments; ///< with an end among these
    std::vector<char> is_renewed, is_new;                         ///< per particle: whether it is among these
    std::vector<Real> radius;                                     ///< per particle, when listed
    std::vector<std::uint32_t> strip;                             ///< per particle, when listed
    std::vector<Row> rows;                                        ///< per particle, when listed
    std::vector<ContactSegment> links;                            ///< segments, when listed
    std::vector<SolidParts> solids_listed;                        ///< in space, when listed

    using SolidPair = std::array<std::uint32_t, 2>;
    std::vector<SolidPair> nested; ///< first segments of solids that overlap when the step begins, in order
    bool is_nested(std::uint32_t a, std::uint32_t b) const {
        if (nested.empty()) return false;
        return std::binary_search(nested.begin(), nested.end(), SolidPair{std::min(a, b), std::max(a, b)});
    }

    // Scratch of the search.
    std::vector<SolidPair> found_nested;
    std::vector<SolidBox<D, Real>> boxes;
    std::vector<std::uint32_t> figure;        ///< per particle
    FeatureGrid<D, Real> particles, segments; ///< when listed; segments where `has_segments`
    FeatureGrid<D, Real> solids;              ///< in space, when listed
    bool has_segments = false;
    FeatureGrid<D, Real> renewed_particles, renewed_segment_grid, renewed_solid_grid; ///< in the order of `renewed`
    std::vector<Vector> renewed_places;
    std::vector<Real> renewed_balls;
    std::vector<Vector> middle;                               ///< per segment
    std::vector<Real> search_radius;                          ///< per particle, then per segment, then per solid
    std::vector<Real> segment_ball;                           ///< per segment: search radius around the middle
    std::vector<Vector> solid_middle;                         ///< per solid: of the box
    std::vector<Real> solid_ball;                             ///< per solid: search radius around the middle
    std::vector<std::uint32_t> renewed_solids, astray_solids; ///< with a corner astray
    std::vector<std::vector<ContactCandidate>> found;         ///< by chunks of features
    std::vector<ContactCandidate> before;                     ///< the last list, by parts
    std::array<std::uint32_t, contact_parts> end_before{};
    std::vector<ContactMultiplier<D, Real>> multipliers_before;

    /// Features at the start of a step. Others than those listed end the list: their numbers differ, as where an area
    /// was turned over and has other segments.
    void note_features(const std::vector<ContactParticle<Real>>& of, const std::vector<ContactSegment>& between,
                       const std::vector<SolidParts>& within) {
        const auto row_of = [](const auto& particle) { return particle.row; };
        if (std::ranges::equal(rows, of, {}, {}, row_of) && links == between && solids_listed == within) return;
        rows.clear();
        for (const auto& particle : of) rows.push_back(particle.row);
        links = between, solids_listed = within;
        is_valid = false;
    }
    /// Fills the grid of the segments.
    void fill_segments() {
        segments.fill(middle, segment_ball);
        has_segments = true;
    }
};

} // namespace sinew::detail

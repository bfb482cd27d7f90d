#pragma once

#include "sinew/solver/cloth/nearest_features.h"

namespace sinew::detail {

/// Linear motion of a pair of features within a substep: corners at the start, and their displacements.
struct PairMotion {
    FeatureCorners<double> start{}, displacement{};
    std::size_t first_side = 1; ///< corners of the first feature

    NearestPoints<double> near_at_start() const { return nearest(0); }
    NearestPoints<double> nearest(double share) const {
        auto corner = start;
        for (std::size_t i = 0; i < 4; ++i) corner[i] += displacement[i] * share;
        auto near = first_side == 1 ? nearest_vertex_face(corner) : nearest_edge_edge(corner);
        if (clearance(corner, first_side, near.normal) < 0.99 * near.distance) part(corner, near);
        return near;
    }
    /// Nearest points of slivers are imprecise: the best parting direction bounds the distance from below.
    void part(const FeatureCorners<double>& corner, NearestPoints<double>& near) const {
        near.normal = PartingDirection(corner, first_side).find();
        near.distance = min(near.distance, max(clearance(corner, first_side, near.normal), 0.0));
    }
    /// Bound on the displacement of any point of one feature relative to any point of the other.
    double fastest() const {
        double max_square = 0;
        for (std::size_t i = 0; i < first_side; ++i)
            for (auto k = first_side; k < 4; ++k) {
                const auto relative = displacement[i] - displacement[k];
                max_square = max(max_square, dot(relative, relative));
            }
        return square_root(max_square);
    }
    /// Gap along a direction at the end of the substep.
    double gap_at_end(const Vec3<double>& normal) const {
        std::array<double, 4> height;
        for (std::size_t i = 0; i < 4; ++i) height[i] = dot(normal, (start[i] - start[0]) + displacement[i]);
        return gap_of(height, first_side);
    }
    /// Relative displacement of the nearest points, by their weights.
    Vec3<double> relative(const NearestPoints<double>& near) const {
        Vec3<double> sum{};
        for (std::size_t i = 0; i < 4; ++i) sum += displacement[i] * near.weight[i];
        return sum;
    }
};

/// Nearest points at the first time, as a share of the substep, at which two features come within a distance.
struct Impact {
    bool is_found = false;
    double share = 0;
    NearestPoints<double> near{};
};

/// Advances a pair until it is nearer than `distance` + `tolerance`: by the distance left at the largest relative
/// speed, so that nothing is passed over (conservative advancement: Mirtich 1996; Li et al., Codimensional Incremental
/// Potential Contact, 2021). The normal of the nearest points parts a pair now; where it still does so at the end it
/// does so all the way. An advance that does not end counts as an impact.
inline Impact first_impact(const PairMotion& motion, const NearestPoints<double>& at_start, double distance,
                           double tolerance) {
    constexpr int max_advances = 96;
    const double per_speed = inverse_or_zero(motion.fastest());
    Impact impact{.near = at_start};
    for (int i = 0; i < max_advances; ++i) {
        const double left = impact.near.distance - distance;
        impact.is_found = left <= tolerance;
        if (impact.is_found || motion.gap_at_end(impact.near.normal) >= distance + tolerance) return impact;
        const double next = impact.share + left * per_speed;
        if (next >= 1) return impact;
        impact.share = next;
        impact.near = motion.nearest(next);
    }
    impact.is_found = true;
    return impact;
}

} // namespace sinew::detail

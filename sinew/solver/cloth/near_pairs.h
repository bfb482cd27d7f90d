#pragma once

#include "sinew/solver/cloth/feature_search.h"
#include "sinew/solver/cloth/thin_contact.h"

#include <algorithm>

namespace sinew::detail {

/// Pairs of the lists that come near in this substep.
template <class Real> class NearPairs {
  public:
    using Vector = Vec3<Real>;

    /// `substep`: the one being solved, counted from 1; `count`: of a step.
    NearPairs(ThinRoom<3, Real>& room, int substep, int count)
        : room_(room), forecasts_(room, substep), substep_(substep), count_(count) {}

    void look_at_all() {
        if (room_.is_static && !is_awake_valid()) find_awake();
        if (!room_.is_static) drop_void();
        for (auto& pairs : room_.pairs) {
            pairs.near.clear();
            pairs.touching.clear();
            if (room_.is_static) {
                look_at_awake(pairs);
            } else {
                look_at(pairs, 0, pairs.in_order);
                near_in_order_[pairs.first_side - 1] = pairs.near.size();
                look_at(pairs, pairs.in_order, pairs.listed.size());
            }
        }
    }
    /// Displacements have changed since the pairs were looked at: a pair already known does no harm again.
    void look_again() {
        drop_void();
        for (auto& pairs : room_.pairs)
            for (auto& pair : pairs.listed)
                if (!pair.is_near) look_at(pairs, pair);
    }
    /// Pairs found later are sorted in between: the order follows from the state alone.
    void list_touching(FeaturePairs<Real>& pairs) {
        const auto list = [&](auto& numbers, std::size_t first, std::size_t last) {
            numbers.clear();
            for (auto i = first; i < last; ++i)
                if (pairs.near[i].is_touching) numbers.push_back(std::uint32_t(i));
        };
        const auto in_order = near_in_order_[pairs.first_side - 1];
        list(room_.merged, 0, in_order);
        list(room_.tail, in_order, pairs.near.size());
        const auto before = [&](auto a, auto b) { return pairs.near[a].vertex < pairs.near[b].vertex; };
        std::sort(room_.tail.begin(), room_.tail.end(), before);
        pairs.touching.resize(room_.merged.size() + room_.tail.size());
        std::merge(room_.merged.begin(), room_.merged.end(), room_.tail.begin(), room_.tail.end(),
                   pairs.touching.begin(), before);
    }

  private:
    ThinRoom<3, Real>& room_;
    ClothForecasts<Real> forecasts_;
    int substep_, count_;
    std::array<std::size_t, 2> near_in_order_{}; ///< pairs that are near, before those found later

    // --- pairs of a static list that may be due within the step ------------------------------------------------------

    /// True as long as no vertex has travelled further than foreseen.
    bool is_awake_valid() const {
        if (substep_ == 1 || room_.travel_bound.size() != room_.ahead.size()) return false;
        for (std::size_t i = 0; i < room_.ahead.size(); ++i)
            if (!(room_.ahead[i] <= room_.travel_bound[i])) return false;
        return true;
    }
    /// Sorts out what cannot be due before some vertex has gone on for a few substeps half as fast again as now; drops
    /// void pairs.
    void find_awake() {
        constexpr double substeps = 8, faster = 1.5;
        room_.travel_bound.resize(room_.ahead.size());
        for (std::size_t i = 0; i < room_.ahead.size(); ++i)
            room_.travel_bound[i] = room_.ahead[i] + 0.02 * double(room_.skin) +
                                    (room_.ahead[i] - room_.vertices[i].travel) * (substeps * faster);
        for (auto& pairs : room_.pairs)
            sort_out(pairs, [&](const FeaturePair& pair) { return sum(room_.travel_bound, pair.vertex) > pair.due; });
    }
    void look_at_awake(FeaturePairs<Real>& pairs) {
        const auto later = std::lower_bound(pairs.awake.begin(), pairs.awake.end(), std::uint32_t(pairs.in_order));
        std::for_each(pairs.awake.begin(), later, [&](auto i) { look_at(pairs, pairs.listed[i]); });
        near_in_order_[pairs.first_side - 1] = pairs.near.size();
        std::for_each(later, pairs.awake.end(), [&](auto i) { look_at(pairs, pairs.listed[i]); });
        look_at(pairs, pairs.sorted_out, pairs.listed.size());
    }

    /// Drops void pairs where they have become many.
    void drop_void() {
        for (auto& pairs : room_.pairs) {
            if (pairs.listed.size() * 4 < pairs.sorted_out * 5) continue;
            sort_out(pairs, [](const FeaturePair&) { return false; });
        }
    }
    /// Drops void pairs, and lists those that are awake.
    template <class Test> void sort_out(FeaturePairs<Real>& pairs, Test&& is_awake) {
        std::size_t kept = 0, in_order = 0;
        pairs.awake.clear();
        for (std::size_t i = 0; i < pairs.listed.size(); ++i) {
            if (i == pairs.in_order) in_order = kept;
            const auto& pair = pairs.listed[i];
            if (is_void(pair)) continue;
            if (is_awake(pair)) pairs.awake.push_back(std::uint32_t(kept));
            pairs.listed[kept++] = pair;
        }
        pairs.in_order = pairs.in_order < pairs.listed.size() ? in_order : kept;
        pairs.sorted_out = kept;
        pairs.listed.resize(kept);
    }

    // --- a pair ------------------------------------------------------------------------------------------------------

    double sum(const std::vector<double>& of, const PairVertices& v) const {
        return (of[v[0]] + of[v[1]]) + (of[v[2]] + of[v[3]]);
    }
    /// True if the pairs of a vertex have been found anew since.
    bool is_void(const FeaturePair& pair) const {
        for (const auto i : pair.vertex)
            if (room_.renewed[i] > pair.renewal) return true;
        return false;
    }
    void look_at(FeaturePairs<Real>& pairs, std::size_t first, std::size_t last) {
        for (auto i = first; i < last; ++i) look_at(pairs, pairs.listed[i]);
    }
    void look_at(FeaturePairs<Real>& pairs, FeaturePair& pair) {
        pair.is_near = false;
        if (substep_ < pair.wake) return;
        const double ahead = sum(room_.ahead, pair.vertex);
        if (!(ahead > pair.due) || is_void(pair)) return;
        measure(pairs, pair, ahead);
    }
    void measure(FeaturePairs<Real>& pairs, FeaturePair& pair, double ahead) {
        FeatureCorners<Real> corner;
        double travel = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto& vertex = room_.vertices[pair.vertex[i]];
            corner[i] = vertex.position, travel += vertex.travel;
        }
        const auto found = pairs.first_side == 1 ? nearest_vertex_face(corner) : nearest_edge_edge(corner);
        const Real thickness = pair_thickness(room_.mesh, pair.vertex, pairs.first_side);
        const Real reach = contact_reach<Real> * thickness;
        pair.due = travel + 0.999 * double(found.distance - reach);
        if (!(ahead > pair.due)) return;
        NearPair<Real> near{.vertex = pair.vertex,
                            .weight = found.weight,
                            .normal = found.normal,
                            .distance = found.distance,
                            .thickness = thickness};
        for (std::size_t i = 0; i < 4; ++i) near.height[i] = dot(found.normal, corner[i] - corner[0]);
        const Real gap = gap_of(near.height, pairs.first_side);
        if (min(gap, gap_ahead(room_, near, pairs.first_side)) >= reach) return sleep(pairs, pair, found, reach);
        pair.is_near = true;
        near.is_parted = gap > Real(0.7) * found.distance;
        near.is_touching = is_touching(near, found.is_inside, pairs.first_side);
        pairs.near.push_back(near);
    }
    /// A plane keeps the pair apart as long as both keep to their forecast.
    void sleep(const FeaturePairs<Real>& pairs, FeaturePair& pair, const NearestPoints<Real>& found, Real reach) {
        if (room_.is_static) return;
        const auto gap = forecasts_.gap(pair.vertex, pairs.first_side, found);
        pair.wake = forecasts_.wake(gap, reach + forecasts_.tolerance(pair.vertex, pairs.first_side));
    }
    /// Beside a face the nearest points count by their places at the end of the substep, be they out of touch at its
    /// start; beside an edge, vertices meet faces.
    bool is_touching(const NearPair<Real>& near, bool is_inside, std::size_t first_side) const {
        if (!is_inside && first_side == 2) return false;
        const auto apart = near.normal * near.distance + relative_displacement(room_, near);
        return (is_inside ? dot(near.normal, apart) : norm(apart)) < contact_reach<Real> * near.thickness;
    }
};

} // namespace sinew::detail

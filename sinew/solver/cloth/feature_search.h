#pragma once

#include "sinew/collide/filter.h"
#include "sinew/solver/cloth/cell_search.h"

#include <algorithm>

/// Search for the pairs of features of thin cloth that may come near. A list holds while every vertex keeps to its
/// forecast; pairs of those that leave it are found anew in the same substep.
namespace sinew::detail {

template <class Real> Real pair_thickness(const ClothMesh<3, Real>& mesh, const PairVertices& v, std::size_t side) {
    const auto half = [&](std::size_t i) { return mesh.half_thickness[v[i]]; };
    if (side == 1) return half(0) + min(half(1), min(half(2), half(3)));
    return Real(0.5) * (min(half(0), half(1)) + min(half(2), half(3))); // layers lie on vertices
}

template <class Real> class FeatureSearch {
  public:
    /// `substep`: the one being solved, counted from 1.
    FeatureSearch(const World<3, Real>& world, ThinRoom<3, Real>& room, int substep)
        : world_(world), room_(room), mesh_(room.mesh), forecasts_(room, substep), cells_(room, forecasts_) {}

    /// Makes the whole list, good until substep `last`; a static one holds as long as nothing has travelled.
    void list(bool is_static, int last) {
        forecasts_.begin_list(is_static, last);
        cells_.clear();
        is_whole_ = true;
        begin();
        for (auto& pairs : room_.pairs) pairs.listed.clear();
        cells_.each_pair([&](auto a, auto b) { visit(a, b); });
        for (auto& pairs : room_.pairs) take_sorted(pairs);
    }

    /// Finds the pairs of the vertices whose predicted places are off the forecast. Their older pairs are void.
    void renew() {
        if (!forecasts_.find_dirty()) return;
        is_whole_ = false;
        forecasts_.forecast_dirty();
        begin();
        cells_.each_dirty_pair([&](auto a, auto b) { visit(a, b); });
        for (auto& pairs : room_.pairs) pairs.listed.insert(pairs.listed.end(), pairs.found.begin(), pairs.found.end());
    }

  private:
    const World<3, Real>& world_;
    ThinRoom<3, Real>& room_;
    const ClothMesh<3, Real>& mesh_;
    ClothForecasts<Real> forecasts_;
    CellSearch<Real> cells_;
    bool is_whole_ = true;

    void begin() {
        ++room_.renewal;
        room_.renewed.resize(mesh_.size());
        for (const auto i : room_.dirty) room_.renewed[i] = room_.renewal;
        for (auto& pairs : room_.pairs) pairs.found.clear();
        cells_.update_boxes();
    }
    void visit(std::uint32_t a, std::uint32_t b) {
        if (!may_touch(a, b)) return;
        find_vertex_face(a, b);
        if (a != b) find_vertex_face(b, a);
        find_edge_edge(a, b);
    }
    FigureIndex figure_of(std::uint32_t cell) const {
        return mesh_.figure[mesh_.corners[mesh_.corner_range[cell].first]];
    }
    bool may_touch(std::uint32_t a, std::uint32_t b) const {
        const auto &one = world_.figures[figure_of(a)], &other = world_.figures[figure_of(b)];
        if (one.cloth != ClothContactKind::thin && other.cloth != ClothContactKind::thin) return false;
        return &one == &other ? one.touches_itself : touch(one.filter, other.filter);
    }

    void find_vertex_face(std::uint32_t a, std::uint32_t b) {
        const auto &own = mesh_.cells[a], &other = mesh_.cells[b];
        for (auto i = own.vertices.first; i < own.vertices.last; ++i) {
            const auto vertex = mesh_.vertex_of_cell[i];
            const auto box = room_.vertex_box[vertex].grown(Real(2) * cells_.edge_share * room_.thickest);
            if (!box.overlaps(room_.cell_box[b])) continue;
            for (auto k = other.faces.first; k < other.faces.last; ++k) {
                const auto& face = mesh_.faces[k];
                if (face[0] == vertex || face[1] == vertex || face[2] == vertex) continue;
                if (box.overlaps(room_.face_box[k])) offer(room_.pairs[0], {vertex, face[0], face[1], face[2]});
            }
        }
    }
    void find_edge_edge(std::uint32_t a, std::uint32_t b) {
        const auto &own = mesh_.cells[a], &other = mesh_.cells[b];
        for (auto i = own.edges.first; i < own.edges.last; ++i) {
            const auto& box = room_.edge_box[i];
            if (!box.overlaps(room_.cell_box[b])) continue;
            const auto& e = mesh_.edges[i];
            for (auto k = a == b ? i + 1 : other.edges.first; k < other.edges.last; ++k) {
                const auto& f = mesh_.edges[k];
                if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) continue;
                if (box.overlaps(room_.edge_box[k])) offer_edges(e, f);
            }
        }
    }
    void offer_edges(const std::array<std::uint32_t, 2>& e, const std::array<std::uint32_t, 2>& f) {
        const auto &low = std::min(e, f), &high = std::max(e, f);
        offer(room_.pairs[1], {low[0], low[1], high[0], high[1]});
    }

    /// Lists a pair that may come within reach while both keep to their forecast.
    void offer(FeaturePairs<Real>& pairs, const PairVertices& v) {
        if (!is_whole_ && !forecasts_.is_any_dirty(v)) return;
        FeatureCorners<Real> corner;
        for (std::size_t i = 0; i < 4; ++i) corner[i] = room_.vertices[v[i]].position;
        const auto near = pairs.first_side == 1 ? nearest_vertex_face(corner) : nearest_edge_edge(corner);
        const Real reach = contact_reach<Real> * pair_thickness(mesh_, v, pairs.first_side);
        const auto gap = forecasts_.gap(v, pairs.first_side, near);
        const Real needed = reach + forecasts_.tolerance(v, pairs.first_side);
        if (!(gap.least() < needed)) return;
        pairs.found.push_back({.vertex = v,
                               .due = travel_of(v) + 0.999 * double(near.distance - reach),
                               .renewal = room_.renewal,
                               .wake = forecasts_.wake(gap, needed)});
    }
    double travel_of(const PairVertices& v) const {
        double sum = 0;
        for (const auto i : v) sum += room_.vertices[i].travel;
        return sum;
    }

    /// Lists the pairs found in the order of their vertices, whatever the order they were found in.
    void take_sorted(FeaturePairs<Real>& pairs) {
        auto& first = room_.first;
        first.assign(mesh_.size() + 1, 0);
        for (const auto& pair : pairs.found) ++first[pair.vertex[0] + 1];
        for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        pairs.listed.resize(pairs.found.size());
        for (const auto& pair : pairs.found) pairs.listed[first[pair.vertex[0]]++] = pair;
        std::uint32_t begin = 0; // first[i] is the end of i now
        for (std::size_t i = 0; i < mesh_.size(); ++i) {
            std::sort(pairs.listed.begin() + begin, pairs.listed.begin() + first[i],
                      [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
            begin = first[i];
        }
        pairs.in_order = pairs.sorted_out = pairs.listed.size();
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/collide/filter.h"
#include "sinew/solver/cloth/thin_room.h"

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
    using Vector = Vec3<Real>;

    /// `substep`: the one being solved, counted from 1.
    FeatureSearch(const World<3, Real>& world, ThinRoom<3, Real>& room, int substep)
        : world_(world), room_(room), mesh_(room.mesh), substep_(substep) {}

    /// Makes the whole list, good until substep `last`; a static one holds as long as nothing has travelled.
    void list(bool is_static, int last) {
        room_.is_static = is_static;
        room_.is_listed = true;
        room_.last_substep = last;
        room_.drift = {};
        room_.mean_displacement = is_static ? Vector{} : mean_displacement();
        room_.is_dirty.assign(mesh_.size(), 1);
        forecast_dirty();
        is_whole_ = true;
        update_boxes();
        for (auto& pairs : room_.pairs) pairs.listed.clear(), pairs.found.clear();
        sort_all_cells();
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell) visit_cell(cell);
        room_.grid.each_pair([&](auto a, auto b) { visit(std::min(a, b), std::max(a, b)); });
        for (auto& pairs : room_.pairs) take_sorted(pairs);
    }

    /// Finds the pairs of the vertices whose predicted places are off the forecast; false if there are none.
    bool renew() {
        if (!mark_dirty()) return false;
        is_whole_ = false;
        for (auto& pairs : room_.pairs) {
            pairs.found.clear();
            drop_dirty(pairs);
        }
        forecast_dirty();
        update_boxes();
        find_around_dirty();
        for (auto& pairs : room_.pairs) pairs.listed.insert(pairs.listed.end(), pairs.found.begin(), pairs.found.end());
        return true;
    }

  private:
    const World<3, Real>& world_;
    ThinRoom<3, Real>& room_;
    const ClothMesh<3, Real>& mesh_;
    int substep_;
    bool is_whole_ = true;
    /// Half the distance at which edges touch, as a share of the thickness (pair_thickness).
    static constexpr Real edge_share = Real(0.25);

    // --- forecast ----------------------------------------------------------------------------------------------------

    Vector mean_displacement() const {
        Vector sum{};
        for (const auto& vertex : room_.vertices) sum += vertex.last_displacement;
        return sum * (Real(1) / Real(room_.vertices.size()));
    }
    /// Mean of the last displacements of a vertex and its neighbours: motion shared with them lasts, its own is gone
    /// within a substep.
    Vector expected_move(std::uint32_t vertex) const {
        Vector sum{};
        if (room_.is_static) return sum;
        Real count = 0;
        for (auto i = mesh_.first_cell_at[vertex]; i < mesh_.first_cell_at[vertex + 1]; ++i) {
            const auto corners = mesh_.corner_range[mesh_.cells_at[i]];
            for (auto k = corners.first; k < corners.last; ++k)
                sum += room_.vertices[mesh_.corners[k]].last_displacement, count += 1;
        }
        return sum * inverse_or_zero(count);
    }
    /// Forecasts of the dirty; what is off already may be off by as much again.
    void forecast_dirty() {
        room_.forecast.resize(mesh_.size());
        for (std::uint32_t i = 0; i < mesh_.size(); ++i) {
            if (!room_.is_dirty[i]) continue;
            auto& vertex = room_.vertices[i];
            vertex.listed_at = vertex.travel;
            auto& forecast = room_.forecast[i];
            forecast = {vertex.position, expected_move(i), room_.skin, substep_ - 1};
            forecast.tolerance += Real(2) * Real(off(i));
        }
    }
    /// Distance from the forecast at the end of the substep; of a static list, the travel since the listing.
    double off(std::uint32_t i) const {
        const auto& vertex = room_.vertices[i];
        if (room_.is_static) return vertex.ahead - vertex.listed_at;
        const auto& forecast = room_.forecast[i];
        return double(norm((vertex.position - forecast.position) + vertex.displacement -
                           forecast.per_substep * Real(substep_ - forecast.since)));
    }
    bool mark_dirty() {
        bool any = false;
        for (std::uint32_t i = 0; i < mesh_.size(); ++i) {
            room_.is_dirty[i] = !(off(i) <= 0.99 * double(room_.forecast[i].tolerance));
            any = any || room_.is_dirty[i];
        }
        return any;
    }
    void drop_dirty(FeaturePairs<Real>& pairs) {
        std::size_t kept = 0, in_order = 0;
        for (std::size_t i = 0; i < pairs.listed.size(); ++i) {
            if (i == pairs.in_order) in_order = kept;
            if (!is_any_dirty(pairs.listed[i].vertex)) pairs.listed[kept++] = pairs.listed[i];
        }
        pairs.in_order = pairs.in_order < pairs.listed.size() ? in_order : kept;
        pairs.listed.resize(kept);
    }
    bool is_any_dirty(const PairVertices& v) const {
        return room_.is_dirty[v[0]] || room_.is_dirty[v[1]] || room_.is_dirty[v[2]] || room_.is_dirty[v[3]];
    }

    // --- boxes -------------------------------------------------------------------------------------------------------

    /// Boxes around the motion until the end of the list, relative to the mean, grown by the skin and half the distance
    /// at which edges touch.
    void update_boxes() {
        room_.vertex_box.resize(mesh_.size());
        for (std::uint32_t i = 0; i < mesh_.size(); ++i)
            if (room_.is_dirty[i]) room_.vertex_box[i] = box_of_vertex(i);
        room_.face_box.resize(mesh_.faces.size());
        room_.edge_box.resize(mesh_.edges.size());
        room_.cell_box.resize(mesh_.cells.size());
        room_.is_dirty_cell.resize(mesh_.cells.size());
        room_.dirty_cells.clear();
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell) {
            room_.is_dirty_cell[cell] = is_whole_ || has_dirty_corner(cell);
            if (room_.is_dirty_cell[cell]) room_.dirty_cells.push_back(cell), update_cell(cell);
        }
    }
    auto box_of_vertex(std::uint32_t i) const {
        const auto& forecast = room_.forecast[i];
        collide::BoundingBox<3, Real> box;
        const auto include = [&](int substep) {
            const auto frame = room_.is_static ? room_.drift : room_.mean_displacement * Real(substep);
            box.include(forecast.position + forecast.per_substep * Real(substep - forecast.since) - frame);
        };
        include(forecast.since);
        if (!room_.is_static) include(room_.last_substep);
        return box.grown(forecast.tolerance + edge_share * room_.thickest);
    }
    bool has_dirty_corner(std::uint32_t cell) const {
        const auto corners = mesh_.corner_range[cell];
        for (auto k = corners.first; k < corners.last; ++k)
            if (room_.is_dirty[mesh_.corners[k]]) return true;
        return false;
    }
    template <class Vertices> auto box_around(const Vertices& vertices) const {
        collide::BoundingBox<3, Real> box;
        for (const auto i : vertices) box.include(room_.vertex_box[i].low), box.include(room_.vertex_box[i].high);
        return box;
    }
    void update_cell(std::uint32_t cell) {
        const auto& own = mesh_.cells[cell];
        for (auto i = own.faces.first; i < own.faces.last; ++i) room_.face_box[i] = box_around(mesh_.faces[i]);
        for (auto i = own.edges.first; i < own.edges.last; ++i) room_.edge_box[i] = box_around(mesh_.edges[i]);
        const auto corners = mesh_.corner_range[cell];
        room_.cell_box[cell] = box_around(std::span(mesh_.corners).subspan(corners.first, corners.last - corners.first))
                                   .grown(edge_share * room_.thickest);
    }

    // --- pairs of cells ----------------------------------------------------------------------------------------------

    Real cell_size(std::span<const std::uint32_t> cells) const {
        Real sum = 0;
        for (const auto cell : cells) {
            const auto& box = room_.cell_box[cell];
            for (int axis = 0; axis < 3; ++axis) sum += box.high[axis] - box.low[axis];
        }
        return sum / Real(3 * cells.size());
    }
    void sort_all_cells() {
        room_.all_cells.resize(mesh_.cells.size());
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell) room_.all_cells[cell] = cell;
        room_.grid.fill(room_.cell_box, room_.all_cells, cell_size(room_.all_cells));
        room_.is_moved_cell.assign(mesh_.cells.size(), 0);
        room_.moved_cells.clear();
    }
    /// Cells that have moved are no longer where the grid of all has them.
    void find_around_dirty() {
        for (const auto cell : room_.dirty_cells) {
            if (room_.is_moved_cell[cell]) continue;
            room_.is_moved_cell[cell] = 1;
            room_.moved_cells.push_back(cell);
        }
        if (room_.moved_cells.size() * 3 > mesh_.cells.size()) {
            sort_all_cells();
            room_.grid.each_pair([&](auto a, auto b) { visit_dirty(a, b); });
        } else {
            room_.moved_grid.fill(room_.cell_box, room_.moved_cells, cell_size(room_.moved_cells));
            for (const auto cell : room_.dirty_cells) find_around(cell);
        }
        for (const auto cell : room_.dirty_cells) visit_cell(cell);
    }
    void find_around(std::uint32_t cell) {
        room_.grid.each_near(room_.cell_box[cell], [&](auto other) {
            if (!room_.is_moved_cell[other]) visit_dirty(cell, other);
        });
        room_.moved_grid.each_near(room_.cell_box[cell], [&](auto other) {
            if (other != cell && (other > cell || !room_.is_dirty_cell[other])) visit_dirty(cell, other);
        });
    }
    void visit_dirty(std::uint32_t a, std::uint32_t b) {
        if (room_.is_dirty_cell[a] || room_.is_dirty_cell[b]) visit(std::min(a, b), std::max(a, b));
    }
    void visit_cell(std::uint32_t cell) {
        if (!may_touch(cell, cell)) return;
        find_vertex_face(cell, cell);
        find_edge_edge(cell, cell);
    }
    void visit(std::uint32_t a, std::uint32_t b) {
        if (!may_touch(a, b)) return;
        find_vertex_face(a, b);
        find_vertex_face(b, a);
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

    // --- pairs of features -------------------------------------------------------------------------------------------

    void find_vertex_face(std::uint32_t a, std::uint32_t b) {
        const auto &own = mesh_.cells[a], &other = mesh_.cells[b];
        for (auto i = own.vertices.first; i < own.vertices.last; ++i) {
            const auto vertex = mesh_.vertex_of_cell[i];
            const auto box = room_.vertex_box[vertex].grown(Real(2) * edge_share * room_.thickest);
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

    /// Lists a pair that may come nearer than its thickness while both keep to their forecast.
    void offer(FeaturePairs<Real>& pairs, const PairVertices& v) {
        if (!is_whole_ && !is_any_dirty(v)) return;
        FeatureCorners<Real> corner;
        for (std::size_t i = 0; i < 4; ++i) corner[i] = room_.vertices[v[i]].position;
        const auto near = pairs.first_side == 1 ? nearest_vertex_face(corner) : nearest_edge_edge(corner);
        const Real thickness = pair_thickness(mesh_, v, pairs.first_side);
        const Real beyond = near.distance - thickness;
        if (!(beyond < tolerance(v, pairs.first_side) + approach(v, pairs.first_side))) return;
        pairs.found.push_back({v, travel_of(v) + 0.999 * double(beyond)});
    }
    /// Largest displacement of a corner relative to one of the other side, by their forecasts, until the list ends.
    Real approach(const PairVertices& v, std::size_t first_side) const {
        if (room_.is_static) return 0;
        Real fastest2 = 0;
        for (std::size_t i = 0; i < first_side; ++i)
            for (std::size_t k = first_side; k < 4; ++k) {
                const auto rate = room_.forecast[v[i]].per_substep - room_.forecast[v[k]].per_substep;
                fastest2 = max(fastest2, dot(rate, rate));
            }
        return square_root(fastest2) * Real(room_.last_substep - substep_ + 1);
    }
    /// Both sides may leave their forecast; a vertex listed before is off already.
    Real tolerance(const PairVertices& v, std::size_t first_side) const {
        std::array<Real, 2> largest{};
        for (std::size_t i = 0; i < 4; ++i) {
            auto& side = largest[i < first_side ? 0 : 1];
            side = max(side, room_.forecast[v[i]].tolerance * Real(room_.is_dirty[v[i]] ? 1 : 2));
        }
        return largest[0] + largest[1];
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
        pairs.in_order = pairs.listed.size();
    }
};

} // namespace sinew::detail

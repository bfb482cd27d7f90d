#pragma once

#include "sinew/solver/cloth/cloth_forecast.h"

namespace sinew::detail {

/// Pairs of cells of cloth whose boxes overlap: of all cells, or of those around dirty vertices.
template <class Real> class CellSearch {
  public:
    CellSearch(ThinRoom<3, Real>& room, const ClothForecasts<Real>& forecasts)
        : room_(room), mesh_(room.mesh), forecasts_(forecasts) {}

    /// Half the reach of edges, as a share of the thickness (pair_thickness).
    static constexpr Real edge_share = Real(0.25) * contact_reach<Real>;

    /// Before a whole list: the mesh may be another one.
    void clear() {
        room_.dirty_cells.clear();
        room_.is_dirty_cell.assign(mesh_.cells.size(), 0);
    }
    /// Boxes of the dirty, grown by half the reach of edges.
    void update_boxes() {
        room_.vertex_box.resize(mesh_.size());
        room_.face_box.resize(mesh_.faces.size());
        room_.edge_box.resize(mesh_.edges.size());
        room_.cell_box.resize(mesh_.cells.size());
        for (const auto i : room_.dirty) room_.vertex_box[i] = forecasts_.box_of(i).grown(edge_share * room_.thickest);
        find_dirty_cells();
        for (const auto cell : room_.dirty_cells) update(cell);
    }
    /// Calls visit(a, b), a <= b, for all pairs.
    template <class Visit> void each_pair(Visit&& visit) {
        sort_all();
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell) visit(cell, cell);
        room_.grid.each_pair([&](auto a, auto b) { visit(std::min(a, b), std::max(a, b)); });
    }
    /// Calls visit(a, b), a <= b, for the pairs with a dirty cell. Cells that have moved are no longer where the grid
    /// of all has them.
    template <class Visit> void each_dirty_pair(Visit&& visit) {
        const auto visit_dirty = [&](auto a, auto b) { visit(std::min(a, b), std::max(a, b)); };
        note_moved();
        if (room_.moved_cells.size() * 3 > mesh_.cells.size()) sort_all();
        room_.moved_grid.fill(room_.cell_box, room_.moved_cells, cell_size(room_.moved_cells));
        for (const auto cell : room_.dirty_cells) each_around(cell, visit_dirty);
        for (const auto cell : room_.dirty_cells) visit(cell, cell);
    }

  private:
    ThinRoom<3, Real>& room_;
    const ClothMesh<3, Real>& mesh_;
    const ClothForecasts<Real>& forecasts_;

    void find_dirty_cells() {
        for (const auto cell : room_.dirty_cells) room_.is_dirty_cell[cell] = 0;
        room_.dirty_cells.clear();
        for (const auto vertex : room_.dirty)
            for (auto i = mesh_.first_cell_at[vertex]; i < mesh_.first_cell_at[vertex + 1]; ++i) {
                const auto cell = mesh_.cells_at[i];
                if (!room_.is_dirty_cell[cell]) room_.dirty_cells.push_back(cell);
                room_.is_dirty_cell[cell] = 1;
            }
    }
    template <class Vertices> auto box_around(const Vertices& vertices) const {
        collide::BoundingBox<3, Real> box;
        for (const auto i : vertices) box.include(room_.vertex_box[i].low), box.include(room_.vertex_box[i].high);
        return box;
    }
    void update(std::uint32_t cell) {
        const auto& own = mesh_.cells[cell];
        for (auto i = own.faces.first; i < own.faces.last; ++i) room_.face_box[i] = box_around(mesh_.faces[i]);
        for (auto i = own.edges.first; i < own.edges.last; ++i) room_.edge_box[i] = box_around(mesh_.edges[i]);
        const auto corners = mesh_.corner_range[cell];
        room_.cell_box[cell] = box_around(std::span(mesh_.corners).subspan(corners.first, corners.last - corners.first))
                                   .grown(edge_share * room_.thickest);
    }
    /// Mean side of the boxes.
    Real cell_size(std::span<const std::uint32_t> cells) const {
        if (cells.empty()) return Real(1);
        Real sum = 0;
        for (const auto cell : cells) {
            const auto& box = room_.cell_box[cell];
            for (int axis = 0; axis < 3; ++axis) sum += box.high[axis] - box.low[axis];
        }
        return sum / Real(3 * cells.size());
    }
    void sort_all() {
        room_.all_cells.resize(mesh_.cells.size());
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell) room_.all_cells[cell] = cell;
        room_.grid.fill(room_.cell_box, room_.all_cells, cell_size(room_.all_cells));
        room_.is_moved_cell.assign(mesh_.cells.size(), 0);
        room_.moved_cells.clear();
    }
    void note_moved() {
        for (const auto cell : room_.dirty_cells) {
            if (room_.is_moved_cell[cell]) continue;
            room_.is_moved_cell[cell] = 1;
            room_.moved_cells.push_back(cell);
        }
    }
    template <class Visit> void each_around(std::uint32_t cell, Visit&& visit) {
        room_.grid.each_near(room_.cell_box[cell], [&](auto other) {
            const bool is_listed = !room_.is_moved_cell[other] && other != cell;
            if (is_listed && (other > cell || !room_.is_dirty_cell[other])) visit(cell, other);
        });
        room_.moved_grid.each_near(room_.cell_box[cell], [&](auto other) {
            if (other != cell && (other > cell || !room_.is_dirty_cell[other])) visit(cell, other);
        });
    }
};

} // namespace sinew::detail

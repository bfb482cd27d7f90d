#pragma once

#include "sinew/solver/sweep_state.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace sinew::detail {

/// Range of numbers.
struct FeatureRange {
    std::uint32_t first = 0, last = 0;
};

/// Cell of cloth with the features that no cell before it has.
struct ClothCell {
    FeatureRange vertices, faces, edges;
};

/// Vertices, edges and faces of all cloth that collides.
template <int D, class Real> struct ClothMesh {
    std::vector<Row> slots;           ///< by vertex
    std::vector<FigureIndex> figure;  ///< by vertex
    std::vector<Real> half_thickness; ///< by vertex, metres
    std::vector<Real> friction;       ///< by vertex
    std::vector<std::array<std::uint32_t, 3>> faces;
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::uint32_t> vertex_of_cell; ///< vertices in the order of the cells that own them
    std::vector<ClothCell> cells;
    std::vector<FeatureRange> corner_range; ///< by cell: its corners
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> first_cell_at, cells_at; ///< by vertex: cells with that corner

    bool empty() const { return cells.empty(); }
    std::size_t size() const { return slots.size(); }
};

/// Cloth that a mesh is made of.
enum class MeshOf : std::uint8_t {
    thin, ///< all whole cells, if some figure asks for thin cloth
    all   ///< all cells, cut ones too
};

/// Finds the mesh of the cloth that collides.
template <int D, class Real> class ClothMeshBuilder {
  public:
    ClothMeshBuilder(const World<D, Real>& world, const SweepState<D, Real>& state, ClothMesh<D, Real>& mesh)
        : world_(world), state_(state), mesh_(mesh) {}

    void build(MeshOf of) {
        mesh_ = {};
        of_ = of;
        if (D != 3) return;
        if (of == MeshOf::thin && std::none_of(world_.figures.begin(), world_.figures.end(), is_thin)) return;
        each_cell([&](FigureIndex, const std::vector<Row>& rows) { list(rows); });
        if (mesh_.slots.empty()) return;
        each_cell([&](FigureIndex figure, const std::vector<Row>& rows) { add(figure, rows); });
        set_thickness();
        list_cells_at();
    }
    static bool is_thin(const Figure& figure) {
        return figure.in_use() && figure.collides && figure.cloth == ClothContactKind::thin;
    }

  private:
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    /// Thickness of a layer as a share of its shortest edges. Two vertices of a flat square mesh without a face in
    /// common are 0.7 cells from each other's features: layers may be no thicker.
    static constexpr Real thickness = Real(0.5);

    const World<D, Real>& world_;
    const SweepState<D, Real>& state_;
    ClothMesh<D, Real>& mesh_;
    MeshOf of_ = MeshOf::thin;
    std::vector<std::uint32_t> number_; ///< by slot
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> edge_;
    std::vector<char> is_owned_; ///< by vertex

    template <class Visit> void each_cell(Visit&& visit) const {
        std::vector<Row> slots;
        for (FigureIndex i = 0; i < world_.figures.size(); ++i) {
            const auto& figure = world_.figures[i];
            if (!figure.in_use() || !figure.collides) continue;
            for (const auto& piece : figure.pieces) {
                if (!is_cell(piece)) continue;
                slots.clear();
                for (const auto id : piece.particles)
                    if (const auto row = world_.particles.handles.find(id); row && is_swept(*row))
                        slots.push_back(state_.slot_of[*row]);
                if (slots.size() == piece.particles.size() && slots.size() >= 3) visit(i, slots);
            }
        }
    }
    bool is_cell(const Piece& piece) const {
        return !piece.hidden && (of_ == MeshOf::all ? is_cloth(piece.mark) : piece.mark == Mark::surface);
    }
    bool is_swept(Row row) const { return state_.slot_of[row] < state_.size(); }

    /// Vertices are numbered in the order of their slots.
    void list(const std::vector<Row>& slots) {
        if (number_.empty()) number_.assign(state_.size(), none);
        for (const Row slot : slots) {
            if (number_[slot] == none) mesh_.slots.push_back(slot);
            number_[slot] = 0;
        }
    }
    void number_vertices() {
        std::sort(mesh_.slots.begin(), mesh_.slots.end());
        for (std::uint32_t i = 0; i < mesh_.size(); ++i) {
            number_[mesh_.slots[i]] = i;
            const auto figure = world_.particles.figure[state_.row_of[mesh_.slots[i]]];
            mesh_.figure.push_back(figure);
            mesh_.friction.push_back(Real(world_.figures[figure].friction));
        }
        is_owned_.assign(mesh_.size(), 0);
    }

    void add(FigureIndex, const std::vector<Row>& slots) {
        if (mesh_.cells.empty()) number_vertices();
        const auto first = std::uint32_t(mesh_.corners.size());
        for (const Row slot : slots) mesh_.corners.push_back(number_[slot]);
        const auto* corner = mesh_.corners.data() + first;
        const auto n = slots.size();
        ClothCell cell{count_of(mesh_.vertex_of_cell), count_of(mesh_.faces), count_of(mesh_.edges)};
        for (std::size_t i = 0; i < n; ++i) {
            own(corner[i]);
            join(corner[i], corner[(i + 1) % n]);
            if (i < 2) continue;
            mesh_.faces.push_back({corner[0], corner[i - 1], corner[i]});
            if (i + 1 < n) join(corner[0], corner[i]);
        }
        cell.vertices.last = std::uint32_t(mesh_.vertex_of_cell.size());
        cell.faces.last = std::uint32_t(mesh_.faces.size());
        cell.edges.last = std::uint32_t(mesh_.edges.size());
        mesh_.cells.push_back(cell);
        mesh_.corner_range.push_back({first, std::uint32_t(mesh_.corners.size())});
    }
    template <class Column> static FeatureRange count_of(const Column& column) {
        return {std::uint32_t(column.size()), std::uint32_t(column.size())};
    }
    void own(std::uint32_t vertex) {
        if (!is_owned_[vertex]) mesh_.vertex_of_cell.push_back(vertex);
        is_owned_[vertex] = 1;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        const std::array<std::uint32_t, 2> ends{std::min(a, b), std::max(a, b)};
        if (edge_.emplace(ends, 0).second) mesh_.edges.push_back(ends);
    }

    /// By the links along edges that are not driven; where a vertex has none left, by its radius. Places are no
    /// measure: they may be stretched, and a copy of the world made later would find others.
    void set_thickness() {
        const auto& table = std::get<kind_number<Distance, D>>(world_.constraints);
        std::map<std::array<std::uint32_t, 2>, Real> length;
        for (Row row = 0; row < table.size(); ++row) {
            const auto ends = std::as_const(table.members)[row];
            const auto a = number_at(ends[0]), b = number_at(ends[1]);
            if (a != none && b != none && table.high(row) < limit::measure<Real> && !table.motorized[row])
                length[{std::min(a, b), std::max(a, b)}] = table.high(row);
        }
        mesh_.half_thickness.assign(mesh_.size(), limit::coordinate<Real>);
        for (const auto& ends : mesh_.edges) {
            const auto known = length.find(ends);
            if (known == length.end()) continue;
            for (const auto end : ends)
                mesh_.half_thickness[end] = min(mesh_.half_thickness[end], Real(0.5) * thickness * known->second);
        }
        for (std::uint32_t i = 0; i < mesh_.size(); ++i)
            if (mesh_.half_thickness[i] == limit::coordinate<Real>)
                mesh_.half_thickness[i] = world_.particles.radius[state_.row_of[mesh_.slots[i]]];
    }
    std::uint32_t number_at(Row row) const { return is_swept(row) ? number_[state_.slot_of[row]] : none; }

    void list_cells_at() {
        auto& first = mesh_.first_cell_at;
        first.assign(mesh_.size() + 2, 0);
        for (const auto vertex : mesh_.corners) ++first[vertex + 2];
        for (std::size_t i = 2; i < first.size(); ++i) first[i] += first[i - 1];
        mesh_.cells_at.resize(mesh_.corners.size());
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell)
            for (auto i = mesh_.corner_range[cell].first; i < mesh_.corner_range[cell].last; ++i)
                mesh_.cells_at[first[mesh_.corners[i] + 1]++] = cell;
    }
};

} // namespace sinew::detail

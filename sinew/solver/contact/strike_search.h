#pragma once

#include "sinew/collide/filter.h"
#include "sinew/solver/contact/face_room.h"
#include "sinew/solver/sweep_state.h"
#include "sinew/world/world.h"

#include <algorithm>

namespace sinew::detail {

/// Search for particles and faces, links and edges, and vertices of cloth and faces of solids, whose motions in a
/// substep come near each other.
template <class Real> class StrikeSearch {
  public:
    using Vector = Vec3<Real>;
    using Box = collide::BoundingBox<3, Real>;

    StrikeSearch(const World<3, Real>& world, const SweepState<3, Real>& state, FaceRoom<3, Real>& room)
        : world_(world), state_(state), room_(room), mesh_(room.mesh) {}

    /// Calls visit(pair) for all pairs whose boxes, grown by margin(thickness), overlap; in the order of the strikers.
    template <class Margin, class Visit> void each_pair(Margin&& margin, Visit&& visit) {
        const auto around = note_vertices();
        const auto grown_box = [&](const Striker<Real>& striker) {
            return box_of(striker).grown(margin(striker.radius + widest_));
        };
        Box reached;
        for (const auto& striker : room_.strikers)
            if (const auto box = grown_box(striker); box.overlaps(around)) include(reached, box);
        list_cells(reached);
        if (room_.near_cells.empty()) return;
        for (std::uint32_t i = 0; i < room_.strikers.size(); ++i) {
            const auto& striker = room_.strikers[i];
            const auto box = grown_box(striker);
            if (!box.overlaps(reached)) continue;
            room_.tree.each_near(box, [&](std::uint32_t number) {
                const auto cell = room_.near_cells[number];
                if (!may_touch(striker, cell)) return;
                striker.is_link ? visit_edges(i, box, cell, visit) : visit_faces(i, box, cell, visit);
            });
        }
        for (const auto& solid : room_.solids) each_vertex_at(solid, margin, visit);
    }
    PairMotion motion(const StrikePair<Real>& pair) const {
        PairMotion motion{.first_side = pair.first_side};
        for (std::size_t i = 0; i < 4; ++i) {
            motion.start[i] = cast<double>(state_.position_at(pair.slot[i]));
            motion.displacement[i] = cast<double>(state_.displacement_at(pair.slot[i]));
        }
        return motion;
    }
    /// Largest coordinate of the cloth.
    Real furthest() const { return furthest_; }

  private:
    const World<3, Real>& world_;
    const SweepState<3, Real>& state_;
    FaceRoom<3, Real>& room_;
    const ClothMesh<3, Real>& mesh_;
    static constexpr Real least = Real(0.1); ///< thickness, as a share of half that of a layer of thin cloth
    Real widest_ = 0;                        ///< largest radius of a vertex
    Real furthest_ = 0;

    // --- boxes -------------------------------------------------------------------------------------------------------

    void include(Box& box, Row slot) const {
        const auto position = state_.position_at(slot);
        box.include(position);
        box.include(position + state_.displacement_at(slot));
    }
    Box box_of(const Striker<Real>& striker) const {
        Box box;
        for (const Row slot : striker.slot) include(box, slot);
        return box;
    }
    static void include(Box& box, const Box& other) { box.include(other.low), box.include(other.high); }
    template <class Vertices> Box box_around(const Vertices& vertices) const {
        Box box;
        for (const auto i : vertices) include(box, room_.vertex_box[i]);
        return box;
    }
    /// Returns the box around all cloth.
    Box note_vertices() {
        room_.vertex_box.clear();
        Box all;
        for (std::uint32_t i = 0; i < mesh_.size(); ++i) {
            Box box;
            include(box, mesh_.slots[i]);
            room_.vertex_box.push_back(box);
            include(all, box);
            widest_ = max(widest_, max(radius_of(i), least * mesh_.half_thickness[i]));
        }
        for (int k = 0; k < 3; ++k) furthest_ = max(furthest_, max(absolute(all.low[k]), absolute(all.high[k])));
        return all;
    }
    /// Fills the tree with the cells within reach of the strikers, in order: a ball is near few cells of a large cloth.
    void list_cells(const Box& reached) {
        room_.near_cells.clear(), room_.cell_box.clear();
        if (reached.high[0] < reached.low[0]) return;
        room_.sides.clear();
        for (const auto& box : room_.vertex_box) room_.sides.push_back(sides_of(box, reached));
        for (std::uint32_t cell = 0; cell < mesh_.cells.size(); ++cell) {
            const auto range = mesh_.corner_range[cell];
            const auto corners = std::span(mesh_.corners).subspan(range.first, range.last - range.first);
            unsigned common = ~0U;
            for (const auto corner : corners) common &= room_.sides[corner];
            if (common != 0) continue;
            room_.near_cells.push_back(cell);
            room_.cell_box.push_back(box_around(corners));
        }
        room_.tree.fill(room_.cell_box.size(), [&](std::size_t i) { return room_.cell_box[i]; });
    }
    /// A bit for each side of the second box that the first is beyond. Boxes that share one do not reach it together.
    static std::uint8_t sides_of(const Box& box, const Box& of) {
        unsigned sides = 0;
        for (unsigned k = 0; k < 3; ++k)
            sides |= unsigned(of.high[k] < box.low[k]) << 2 * k | unsigned(box.high[k] < of.low[k]) << (2 * k + 1);
        return std::uint8_t(sides);
    }

    // --- pairs -------------------------------------------------------------------------------------------------------

    Row row_of(std::uint32_t vertex) const { return state_.row_of[mesh_.slots[vertex]]; }
    Real radius_of(std::uint32_t vertex) const { return world_.particles.radius[row_of(vertex)]; }
    bool may_touch(const Striker<Real>& striker, std::uint32_t cell) const {
        const auto cloth = mesh_.figure[mesh_.corners[mesh_.corner_range[cell].first]];
        const auto& figure = world_.figures[cloth];
        if (cloth == striker.figure) return figure.touches_itself;
        return touch(figure.filter, world_.figures[striker.figure].filter);
    }
    /// Distance that a striker keeps from the middle of a face; particles without a radius keep a little.
    template <std::size_t count>
    Real thickness(const Striker<Real>& striker, const std::array<std::uint32_t, count>& vertices) const {
        Real radius = radius_of(vertices[0]), half = mesh_.half_thickness[vertices[0]];
        for (const auto i : vertices) radius = min(radius, radius_of(i)), half = min(half, mesh_.half_thickness[i]);
        return max(striker.radius + radius, least * half);
    }

    template <class Visit> void visit_faces(std::uint32_t number, const Box& box, std::uint32_t cell, Visit& visit) {
        const auto& striker = room_.strikers[number];
        for (auto i = mesh_.cells[cell].faces.first; i < mesh_.cells[cell].faces.last; ++i) {
            const auto& face = mesh_.faces[i];
            if (!box_around(face).overlaps(box) || is_joined(striker, face)) continue;
            visit(StrikePair<Real>{
                .slot = {striker.slot[0], mesh_.slots[face[0]], mesh_.slots[face[1]], mesh_.slots[face[2]]},
                .first_side = 1,
                .striker = number,
                .vertex = face[0],
                .thickness = thickness(striker, face)});
        }
    }
    template <class Visit> void visit_edges(std::uint32_t number, const Box& box, std::uint32_t cell, Visit& visit) {
        const auto& striker = room_.strikers[number];
        for (auto i = mesh_.cells[cell].edges.first; i < mesh_.cells[cell].edges.last; ++i) {
            const auto& edge = mesh_.edges[i];
            if (!box_around(edge).overlaps(box) || is_joined(striker, edge)) continue;
            visit(
                StrikePair<Real>{.slot = {striker.slot[0], striker.slot[1], mesh_.slots[edge[0]], mesh_.slots[edge[1]]},
                                 .first_side = 2,
                                 .striker = number,
                                 .vertex = edge[0],
                                 .thickness = thickness(striker, edge)});
        }
    }

    // --- solids ------------------------------------------------------------------------------------------------------

    Box box_around_face(const std::array<std::uint32_t, 3>& face) const {
        Box box;
        for (const auto corner : face) include(box, box_of(room_.strikers[corner]));
        return box;
    }
    template <class Margin, class Visit> void each_vertex_at(const SolidStriker& solid, Margin&& margin, Visit& visit) {
        const auto& lead = room_.strikers[solid.lead];
        Box box;
        for (auto i = solid.first_face; i < solid.last_face; ++i) include(box, box_around_face(room_.solid_faces[i]));
        const Real reach = margin(lead.radius + widest_);
        room_.tree.each_near(box.grown(reach), [&](std::uint32_t number) {
            const auto cell = room_.near_cells[number];
            if (!may_touch(lead, cell)) return;
            for (auto i = mesh_.cells[cell].vertices.first; i < mesh_.cells[cell].vertices.last; ++i)
                if (const auto vertex = mesh_.vertex_of_cell[i]; room_.vertex_box[vertex].overlaps(box.grown(reach)))
                    visit_solid(solid, vertex, reach, visit);
        });
    }
    /// A vertex outside may strike any face, as the solid turns; a vertex inside comes out of the nearest.
    template <class Visit> void visit_solid(const SolidStriker& solid, std::uint32_t vertex, Real reach, Visit& visit) {
        const auto x = cast<double>(state_.position_at(mesh_.slots[vertex]));
        auto side = StrikeSide::inside;
        auto nearest = solid.first_face;
        double least = std::numeric_limits<double>::infinity();
        for (auto i = solid.first_face; i < solid.last_face; ++i) {
            const auto corner = corners_of(room_.solid_faces[i], x);
            if (const double away = nearest_vertex_face(corner).distance; away < least) nearest = i, least = away;
            if (is_in_front(corner)) side = StrikeSide::before;
        }
        for (auto i = solid.first_face; i < solid.last_face; ++i) {
            const auto& face = room_.solid_faces[i];
            if (i != nearest && side == StrikeSide::inside) continue;
            if (!room_.vertex_box[vertex].overlaps(box_around_face(face).grown(reach))) continue;
            const bool is_nearest = i == nearest && side == StrikeSide::before;
            visit_solid_face(face, vertex, is_nearest ? StrikeSide::nearest : side, visit);
        }
    }
    template <class Visit>
    void visit_solid_face(const std::array<std::uint32_t, 3>& face, std::uint32_t vertex, StrikeSide side,
                          Visit& visit) {
        StrikePair<Real> pair{.slot = {mesh_.slots[vertex]}, .striker = face[0], .vertex = vertex, .side = side};
        Real radius = std::numeric_limits<Real>::max();
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& corner = room_.strikers[face[i]];
            if (are_linked(corner.row[0], row_of(vertex))) return;
            pair.slot[i + 1] = corner.slot[0];
            radius = min(radius, corner.radius);
        }
        pair.thickness = max(radius + radius_of(vertex), least * mesh_.half_thickness[vertex]);
        visit(pair);
    }
    FeatureCorners<double> corners_of(const std::array<std::uint32_t, 3>& face, const Vec3<double>& x) const {
        FeatureCorners<double> corner{x};
        for (std::size_t i = 0; i < 3; ++i)
            corner[i + 1] = cast<double>(state_.position_at(room_.strikers[face[i]].slot[0]));
        return corner;
    }
    static bool is_in_front(const FeatureCorners<double>& corner) {
        return dot(cross(corner[2] - corner[1], corner[3] - corner[1]), corner[0] - corner[1]) > 0;
    }

    /// True if a link joins a striker to a corner, or a link of its own begins in a cell of that corner.
    template <std::size_t count>
    bool is_joined(const Striker<Real>& striker, const std::array<std::uint32_t, count>& vertices) const {
        for (std::size_t end = 0; end < (striker.is_link ? 2 : 1); ++end) {
            const auto own = room_.vertex_at[striker.slot[end]];
            for (const auto vertex : vertices)
                if (are_linked(striker.row[end], row_of(vertex)) || (own < mesh_.size() && share_a_cell(own, vertex)))
                    return true;
        }
        return false;
    }
    bool are_linked(Row a, Row b) const {
        return !room_.links.empty() && std::binary_search(room_.links.begin(), room_.links.end(),
                                                          std::array<Row, 2>{std::min(a, b), std::max(a, b)});
    }
    bool share_a_cell(std::uint32_t a, std::uint32_t b) const {
        for (auto i = mesh_.first_cell_at[a]; i < mesh_.first_cell_at[a + 1]; ++i) {
            const auto range = mesh_.corner_range[mesh_.cells_at[i]];
            for (auto k = range.first; k < range.last; ++k)
                if (mesh_.corners[k] == b) return true;
        }
        return false;
    }
};

} // namespace sinew::detail

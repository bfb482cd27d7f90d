#pragma once

#include "sinew/solver/cloth/box_grid.h"
#include "sinew/solver/cloth/cloth_mesh.h"
#include "sinew/solver/cloth/nearest_features.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sinew::detail {

/// Distance up to which a pair is solved, as a share of its thickness: corrections of other pairs bring it nearer in
/// the same pass. Pairs chosen by the motion of links alone would come and go by turns, and cloth at rest would
/// tremble.
template <class Real> inline constexpr Real contact_reach = Real(1.05);

/// Vertices of a pair: a vertex and a face, or two edges.
using PairVertices = std::array<std::uint32_t, 4>;

/// Pair that may come near while particles keep to their forecast.
struct FeaturePair {
    PairVertices vertex{};
    double due = 0;            ///< sum of the travels of the vertices from which it may be within reach
    std::uint32_t renewal = 0; ///< number of the search that found it
    std::uint16_t wake = 0;    ///< substep before which it cannot be within reach, by the forecasts
    bool is_near = false;      ///< in this substep
};

/// Pair near enough to be looked at in this substep.
template <class Real> struct NearPair {
    PairVertices vertex{};
    std::array<Real, 4> weight{};
    std::array<Real, 4> height{}; ///< of the corners over the first one, along the normal, at the start of the substep
    Vec3<Real> normal{};
    Real distance = 0; ///< at the start of the substep
    Real thickness = 0;
    bool is_touching = false; ///< within reach, or about to be
    bool is_parted = true;    ///< the normal parts the pair
    bool is_fixed = false;    ///< moves are truncated at its plane
};

/// Pairs of one sort: `first_side` corners belong to the first feature.
template <class Real> struct FeaturePairs {
    explicit FeaturePairs(std::size_t corners) : first_side(corners) {}
    std::size_t first_side;
    std::vector<FeaturePair> listed, found;
    std::size_t in_order = 0;         ///< pairs listed in the order of their vertices, before those found later
    std::vector<std::uint32_t> awake; ///< numbers of the pairs of a static list that may be due (near_pairs.h)
    std::size_t sorted_out = 0;       ///< pairs looked through for `awake`, before those found later
    std::vector<NearPair<Real>> near;
    std::vector<std::uint32_t> touching; ///< numbers in `near`, in the order of the vertices
};

/// Vertex in a substep.
template <class Real> struct ThinVertex {
    Vec3<Real> position{}, displacement{}; ///< start of the substep, displacement in it
    Vec3<Real> last_displacement{};        ///< displacement in the last substep
    Real mobility = 0;
    // Travel: sum of displacements relative to the mean, metres.
    double travel = 0;    ///< at the start of the substep
    double listed_at = 0; ///< when its pairs were found
    double step_began_at = 0;
};

/// Forecast of a vertex: place + per_substep (substep - since), off by a tolerance at most.
template <class Real> struct ClothForecast {
    Vec3<Real> position{}, per_substep{};
    Real tolerance = 0; ///< metres; of a static list, of the travel
    int since = 0;
};

/// Thin cloth during a step; in three dimensions only.
template <int D, class Real> struct ThinRoom {
    ClothMesh<D, Real> mesh;
    std::vector<ThinVertex<Real>> vertices;
    std::vector<ClothForecast<Real>> forecast;
    std::vector<double> ahead;          ///< by vertex: travel at the end of the substep
    std::vector<double> travel_bound;   ///< by vertex: travel up to which `awake` holds
    std::vector<std::uint32_t> renewed; ///< by vertex: number of the last search for its pairs
    std::uint32_t renewal = 0;          ///< number of the last search
    std::vector<std::uint32_t> dirty;   ///< vertices off their forecast
    std::vector<char> is_dirty;
    std::array<FeaturePairs<Real>, 2> pairs{FeaturePairs<Real>(1),
                                            FeaturePairs<Real>(2)}; ///< vertex and face, two edges

    // Search.
    BoxGrid<Real> grid, moved_grid; ///< of cells when the whole list was made; of those that have moved since
    std::vector<collide::BoundingBox<3, Real>> vertex_box, face_box, edge_box, cell_box;
    std::vector<std::uint32_t> all_cells, dirty_cells, moved_cells;
    std::vector<char> is_dirty_cell, is_moved_cell;
    std::vector<std::uint32_t> first;        ///< scratch: first pair of a vertex
    std::vector<std::uint32_t> tail, merged; ///< scratch
    Vec3<Real> mean_displacement{};          ///< of a list that looks ahead: frame of the boxes, per substep
    int last_substep = 0;                    ///< until which the list looks ahead
    Vec3<Real> drift{};                      ///< of a static list: mean displacement since; frame of the boxes

    bool is_listed = false;                   ///< there is a list
    bool is_static = false;                   ///< it holds while vertices travel within the skin
    bool is_calm = false;                     ///< in this step a static list serves
    Real skin = 0, min_gap = 0, thickest = 0; ///< metres

    bool empty() const { return mesh.empty(); }
    /// Reserves for layers in contact with others everywhere; lists grow where cloth crumples.
    void reserve() {
        constexpr std::size_t pairs_each = 48, near_each = 16;
        for (auto& kind : pairs) {
            for (auto* list : {&kind.listed, &kind.found}) list->reserve(pairs_each * mesh.size());
            kind.awake.reserve(pairs_each * mesh.size());
            kind.near.reserve(near_each * mesh.size());
            kind.touching.reserve(near_each * mesh.size());
        }
        for (auto* numbers : {&tail, &merged}) numbers->reserve(near_each * mesh.size());
        for (auto* numbers : {&all_cells, &dirty_cells, &moved_cells}) numbers->reserve(mesh.cells.size());
        for (auto* flags : {&is_dirty_cell, &is_moved_cell}) flags->reserve(mesh.cells.size());
        for (auto* sorted : {&grid, &moved_grid}) sorted->reserve(mesh.cells.size());
        for (auto* numbers : {&dirty, &renewed}) numbers->reserve(mesh.size());
        for (auto* travels : {&ahead, &travel_bound}) travels->reserve(mesh.size());
        is_dirty.reserve(mesh.size());
        forecast.reserve(mesh.size());
        first.reserve(mesh.size() + 1);
        vertices.reserve(mesh.size());
        vertex_box.reserve(mesh.size());
        face_box.reserve(mesh.faces.size());
        edge_box.reserve(mesh.edges.size());
        cell_box.reserve(mesh.cells.size());
    }
};

/// Displacement of the nearest point of the first feature relative to that of the second.
template <class Real> Vec3<Real> relative_displacement(const ThinRoom<3, Real>& room, const NearPair<Real>& near) {
    Vec3<Real> sum{};
    for (std::size_t i = 0; i < 4; ++i) sum += room.vertices[near.vertex[i]].displacement * near.weight[i];
    return sum;
}
/// Gap along the normal at the end of the substep.
template <class Real>
Real gap_ahead(const ThinRoom<3, Real>& room, const NearPair<Real>& near, std::size_t first_side) {
    auto height = near.height;
    for (std::size_t i = 0; i < 4; ++i) height[i] += dot(near.normal, room.vertices[near.vertex[i]].displacement);
    return gap_of(height, first_side);
}

} // namespace sinew::detail

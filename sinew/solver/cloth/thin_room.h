#pragma once

#include "sinew/solver/cloth/box_grid.h"
#include "sinew/solver/cloth/cloth_mesh.h"
#include "sinew/solver/cloth/nearest_features.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sinew::detail {

/// Vertices of a pair: a vertex and a face, or two edges.
using PairVertices = std::array<std::uint32_t, 4>;

/// Pair that may come near while particles keep to their forecast.
struct FeaturePair {
    PairVertices vertex{};
    double due = 0;       ///< sum of the travels of the vertices from which it may be nearer than the thickness
    bool is_near = false; ///< in this substep
};

/// Pair near enough to be looked at in this substep.
template <class Real> struct NearPair {
    PairVertices vertex{};
    std::array<Real, 4> weight{};
    std::array<Real, 4> height{}; ///< of the corners over the first one, along the normal, at the start of the substep
    Vec3<Real> normal{};
    Real distance = 0; ///< at the start of the substep
    Real thickness = 0;
    bool is_touching = false; ///< nearer than the thickness, or about to be
    bool is_parted = true;    ///< the normal parts the pair
    bool is_fixed = false;    ///< moves are truncated at its plane
};

/// Pairs of one sort: `first_side` corners belong to the first feature.
template <class Real> struct FeaturePairs {
    explicit FeaturePairs(std::size_t corners) : first_side(corners) {}
    std::size_t first_side;
    std::vector<FeaturePair> listed, found;
    std::size_t in_order = 0; ///< pairs listed in the order of their vertices, before those found later
    std::vector<NearPair<Real>> near;
    std::vector<std::uint32_t> touching; ///< numbers in `near`, in the order of the vertices
};

/// Vertex in a substep.
template <class Real> struct ThinVertex {
    Vec3<Real> position{}, displacement{}; ///< start of the substep, displacement in it
    Vec3<Real> last_displacement{};        ///< displacement in the last substep
    Real mobility = 0;
    // Travel: sum of displacements relative to the mean, metres.
    double travel = 0, ahead = 0; ///< at the start and at the end of the substep
    double listed_at = 0;         ///< when its pairs were found
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
    /// Reserves for layers in contact with two others everywhere.
    void reserve() {
        constexpr std::size_t pairs_each = 16, near_each = 8;
        for (auto& kind : pairs) {
            for (auto* list : {&kind.listed, &kind.found}) list->reserve(pairs_each * mesh.size());
            kind.near.reserve(near_each * mesh.size());
            kind.touching.reserve(near_each * mesh.size());
        }
        for (auto* numbers : {&tail, &merged}) numbers->reserve(near_each * mesh.size());
        for (auto* numbers : {&all_cells, &dirty_cells, &moved_cells}) numbers->reserve(mesh.cells.size());
        for (auto* sorted : {&grid, &moved_grid}) sorted->reserve(mesh.cells.size());
        first.reserve(mesh.size() + 1);
        vertices.reserve(mesh.size());
    }
};

} // namespace sinew::detail

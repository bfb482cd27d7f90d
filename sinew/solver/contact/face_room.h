#pragma once

#include "sinew/solver/cloth/box_tree.h"
#include "sinew/solver/cloth/cloth_mesh.h"
#include "sinew/solver/cloth/impact.h"
#include "sinew/solver/contact/contact_row.h"

#include <array>
#include <vector>

namespace sinew::detail {

/// Particle or link that may strike the faces of cloth; a particle has two equal ends.
template <class Real> struct Striker {
    std::array<Row, 2> slot{}, row{}; ///< of the sweep, and of the world
    FigureIndex figure = no_figure;
    Real radius = 0, friction = 0;
    bool is_link = false;
};

/// Place of a vertex beside a face of a solid.
enum class StrikeSide : std::uint8_t {
    nearest, ///< no other face is nearer; likewise all other pairs
    before,  ///< another face is nearer
    inside   ///< within the solid
};

/// A particle and a face of cloth, a link and an edge, or a vertex of cloth and a face of a solid.
template <class Real> struct StrikePair {
    std::array<Row, 4> slot{};
    std::size_t first_side = 1;            ///< corners of the first feature
    std::uint32_t striker = 0, vertex = 0; ///< vertex of the mesh: some corner
    Real thickness = 0;
    StrikeSide side = StrikeSide::nearest;
};

/// Solid that the vertices of cloth may strike: its faces, and a corner.
struct SolidStriker {
    std::uint32_t first_face = 0, last_face = 0;
    std::uint32_t lead = 0; ///< striker
};

/// Features that a row of contact holds apart.
struct FaceTouch {
    std::uint32_t striker = 0, vertex = 0;
};

/// Contact of faces of cloth with particles and links of other figures, during a step; in three dimensions only.
template <int D, class Real> struct FaceRoom {
    using Box = collide::BoundingBox<3, Real>;

    ClothMesh<D, Real> mesh;
    std::vector<std::uint32_t> vertex_at; ///< by slot: number of the vertex of the mesh, or none
    std::vector<Striker<Real>> strikers;
    std::vector<std::uint32_t> striker_of; ///< by colliding particle
    std::vector<SolidStriker> solids;
    std::vector<std::array<std::uint32_t, 3>> solid_faces; ///< of these, in turn; strikers
    std::vector<std::array<Row, 2>> links;                 ///< rows of linked particles, one of them of cloth; sorted

    std::vector<Box> vertex_box;           ///< around the motions of a substep
    std::vector<std::uint8_t> sides;       ///< per vertex: sides of what strikers reach that its box is beyond
    std::vector<std::uint32_t> near_cells; ///< within that reach
    std::vector<Box> cell_box;             ///< of the near cells
    BoxTree<Real> tree;                    ///< of these
    std::vector<ContactRow<D, Real>> rows; ///< of this substep
    std::vector<FaceTouch> touches;        ///< of the rows

    // Guard.
    struct Hit {
        StrikePair<Real> pair;
        Impact impact;
    };
    std::vector<Hit> hits;
    std::vector<Row> zone_of;             ///< by slot: another slot of its zone, or itself
    std::vector<Row> zoned;               ///< slots in zones
    std::vector<Vec<D, double>> momentum; ///< by slot at the root of a zone: sum of mass times displacement
    std::vector<double> mass;             ///< by slot at the root of a zone

    bool empty() const { return mesh.empty() || strikers.empty(); }
    /// Reserves for every striker on a few faces; `slots`: of the sweep.
    void reserve(std::size_t slots) {
        constexpr std::size_t rows_each = 6;
        vertex_box.reserve(mesh.size());
        sides.reserve(mesh.size());
        near_cells.reserve(mesh.cells.size());
        cell_box.reserve(mesh.cells.size());
        tree.reserve(mesh.cells.size());
        rows.reserve(rows_each * strikers.size());
        touches.reserve(rows_each * strikers.size());
        hits.reserve(rows_each * strikers.size());
        zoned.reserve(slots);
        zone_of.resize(slots), momentum.resize(slots), mass.resize(slots);
        for (Row slot = 0; slot < slots; ++slot) zone_of[slot] = slot;
    }
};

} // namespace sinew::detail

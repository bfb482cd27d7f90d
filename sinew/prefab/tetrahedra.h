#pragma once

#include "sinew/prefab/obj.h"

#include <array>
#include <cstdint>
#include <vector>

/// Solids made of tetrahedra.
///
/// A solid is filled by a body-centred cubic lattice, whose tetrahedra are all alike and nearly regular. Those inside,
/// or no further out than a quarter of a cell, are kept, and the points of their surface are moved to the surface of
/// the solid: a simple form of isosurface stuffing (Labelle and Shewchuk 2007). A point whose tetrahedra would become
/// flat by it stays nearer to its place in the lattice.
namespace sinew {

/// Region of space with a closed surface.
class Solid {
  public:
    virtual ~Solid() = default;
    virtual std::array<Vec3<double>, 2> corners() const = 0; ///< low and high, of a box around the solid
    virtual bool contains(const Vec3<double>& point) const = 0;
    /// Nearest point of the surface, if there is one within `reach`.
    virtual bool nearest(const Vec3<double>& point, double reach, Vec3<double>& found) const = 0;
};

/// A ball about the origin.
class BallSolid final : public Solid {
  public:
    explicit BallSolid(double radius) : radius_(radius) {}
    std::array<Vec3<double>, 2> corners() const override;
    bool contains(const Vec3<double>& point) const override { return norm(point) <= radius_; }
    bool nearest(const Vec3<double>& point, double reach, Vec3<double>& found) const override;

  private:
    double radius_;
};

struct TetraMesh {
    std::vector<Vec3<double>> points;
    std::vector<std::array<std::uint32_t, 4>> tetrahedra; ///< of positive volume
    std::vector<std::array<std::uint32_t, 2>> edges;      ///< each once, in order
    std::vector<std::array<std::uint32_t, 3>> surface;    ///< triangles, counter-clockwise seen from outside
};

/// Fills a solid with tetrahedra, `cells` of the lattice along the longest side of its box. Empty for a solid thinner
/// than a cell.
TetraMesh fill_with_tetrahedra(const Solid& solid, int cells);

/// The inside of a mesh: points around which its faces wind. Holes smaller than a cell do no harm.
TetraMesh fill_with_tetrahedra(const MeshModel& model, int cells);

/// Edges of the faces of a mesh that do not belong to two faces: 0 if the mesh is closed.
std::size_t open_edges(const MeshModel& model);

} // namespace sinew

#pragma once

#include "files/in/simplify.h"

#include <array>
#include <cstddef>

namespace sinew::files {

/// Triangles of an area with holes. Points of the outlines come first, outline by outline, in order; then those inside.
struct AreaMesh {
    std::vector<Vec2<double>> points;
    std::vector<std::size_t> ends; ///< end of each outline in `points`; the first is the outer one
    std::vector<std::array<std::size_t, 3>> triangles;

    std::size_t begin_of(std::size_t outline) const { return outline == 0 ? 0 : ends[outline - 1]; }
};

/// Delaunay triangles (Bowyer and Watson 1981) of an area: the first outline without the holes that follow. With a
/// spacing, points of a hexagonal lattice are put inside. Edges of outlines that are no edge of a triangle are halved
/// until they are (conforming). No triangles where they would need more than `max_points`.
AreaMesh triangulated(std::vector<Outline> outlines, double spacing, std::size_t max_points);

/// True inside the first outline and outside of the others.
bool is_in_area(const std::vector<Outline>& outlines, const Vec2<double>& point);

} // namespace sinew::files

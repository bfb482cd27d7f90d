#pragma once

#include "sinew/math/vec.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sinew {

/// Points and faces of a mesh. The corners of all faces are in one list; `ends` holds the end of each face in
/// `corners`.
struct MeshModel {
    std::vector<Vec3<double>> points;
    std::vector<std::uint32_t> corners; ///< indices of points, from 0
    std::vector<std::uint32_t> ends;
    std::size_t welded = 0; ///< points that weld() has merged with others

    std::size_t faces() const { return ends.size(); }
    std::span<const std::uint32_t> face(std::size_t i) const {
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return std::span(corners).subspan(begin, ends[i] - begin);
    }
};

/// Reason why a file cannot be used, and the number of the line, from 1; 0 for the file as a whole.
struct ObjProblem {
    std::size_t line = 0;
    std::string message;
};

struct ObjLimits {
    std::size_t points = 1'000'000;
    std::size_t corners = 8'000'000;
};

/// Reads the `v` and `f` lines of a Wavefront OBJ file. UnfoldedTriangles are `v`, `v/vt`, `v//vn` or `v/vt/vn`,
/// counted from 1, or backwards from the last with a minus. Normals, texture coordinates, names, groups, materials,
/// lines and points are ignored. Curves and all other keywords are errors. Points that no face uses are kept.
std::variant<MeshModel, ObjProblem> read_obj(std::string_view text, const ObjLimits& limits = {});

/// Share of the size of a model, its diagonal, within which two points coincide: rounding of float, or of six decimals.
inline constexpr double weld_share = 1e-7;

/// The model with points at the same place, to within `weld_share`, merged into the first of them: faces that shared no
/// point, as scanners and programs for printing write them, then hold together. Corners of a face that become one are
/// one; faces of fewer than three are left out.
MeshModel weld(const MeshModel& model);

/// Writes the model as an OBJ file. Reading the file back gives identical bits.
std::string to_obj(const MeshModel& model);

} // namespace sinew

#pragma once

#include "sinew/math/vec.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sinew {

/// Points and the faces between them. Corners of all faces in one list; `ends` says where each face's end.
struct MeshModel {
    std::vector<Vec3<double>> points;
    std::vector<std::uint32_t> corners; ///< numbers of points, from 0
    std::vector<std::uint32_t> ends;

    std::size_t faces() const { return ends.size(); }
    std::span<const std::uint32_t> face(std::size_t i) const {
        const std::size_t begin = i == 0 ? 0 : ends[i - 1];
        return std::span(corners).subspan(begin, ends[i] - begin);
    }
};

/// Why a file cannot be used, and in which of its lines, from 1; 0 where it is about the whole.
struct ObjProblem {
    std::size_t line = 0;
    std::string message;
};

struct ObjLimits {
    std::size_t points = 1'000'000;
    std::size_t corners = 8'000'000;
};

/// Reads a Wavefront OBJ file: its `v` and `f` lines. Corners are `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or
/// back from the last with a minus. Normals, texture places, names, groups, materials, lines and points are passed
/// over; curves, and whatever else no mesh has, are refused. A point that no face names is kept.
std::variant<MeshModel, ObjProblem> read_obj(std::string_view text, const ObjLimits& limits = {});

/// The model as an OBJ file that read_obj gives back bit by bit.
std::string to_obj(const MeshModel& model);

} // namespace sinew

#pragma once

#include "files/out/mesh_film.h"

#include <string>
#include <vector>

namespace sinew::files {

struct GlbMotion {
    double fps = 30;
    double tolerance = 0;   ///< metres by which points may be off between keys
    std::size_t joints = 0; ///< that carry a mesh; 0: morph targets
};

/// A film as a binary glTF. Figures that move as rigid bodies are nodes with what they are made of below; otherwise
/// lines are rods, a node for each straight part, balls are nodes, and faces a mesh with a morph target for each key,
/// or skinned to joints. The error of rigid nodes is told in `notes`.
[[nodiscard]] Failure glb_of(const MeshFilm& film, const GlbMotion& motion, std::string& bytes,
                             std::vector<std::string>& notes);

} // namespace sinew::files

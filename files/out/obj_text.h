#pragma once

#include "files/out/scene_mesh.h"

#include <string>
#include <vector>

namespace sinew::files {

/// Names of the groups' materials: figure and part, without spaces, each different.
std::vector<std::string> material_names(const std::vector<MeshGroup>& groups);

/// The mesh as a Wavefront OBJ of one object. `materials`: name of the .mtl file.
std::string obj_text(const SceneMesh& mesh, const std::string& materials);
/// Materials of the groups as a .mtl file.
std::string mtl_text(const std::vector<MeshGroup>& groups);

} // namespace sinew::files

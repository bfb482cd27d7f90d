#pragma once

#include "sinew/scene/scene.h"

namespace sinew {

/// Loads the models of a scene's meshes, each file once. Errors in a file are reported at the mesh that names the file.
void read_models(Scene& scene, const ModelReader& reader, Document& document);

} // namespace sinew

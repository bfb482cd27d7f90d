#pragma once

#include "sinew/scene/scene.h"

namespace sinew {

/// Gives the meshes of a scene the models they name, each file read once. What is wrong with a file is said at the
/// place of its name.
void read_models(Scene& scene, const ModelReader& reader, Document& document);

} // namespace sinew

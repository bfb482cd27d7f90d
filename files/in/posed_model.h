#pragma once

#include "files/in/import.h"
#include "files/out/exporter.h"

namespace sinew::files {

/// A .glb of a glTF model whose skeleton was imported as a ragdoll: the model's meshes, skins, materials and images as
/// they are, moved by the ragdoll. Throws ImportError where the model cannot be read, or has no skeleton.
std::unique_ptr<Exporter> open_posed_model(const ExportRequest& request, const ImportFile& model);

} // namespace sinew::files

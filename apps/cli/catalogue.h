#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// Folder of scenes with a name.
namespace sinew::cli {

/// Path of the catalogue, the first of: SINEW_SCENES in the environment; ../share/sinew/scenes beside the executable's
/// folder, if present (installed); the scenes of the source tree.
std::filesystem::path catalogue_folder();

/// Names of all scenes, in alphabetical order.
std::vector<std::string> catalogue_names();

std::filesystem::path catalogue_path(const std::string& name);

} // namespace sinew::cli

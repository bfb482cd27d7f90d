#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The folder of scenes that can be called by name.
namespace sinew::cli {

/// Where it is, the first of these: what SINEW_SCENES in the environment says; ../share/sinew/scenes beside the folder
/// of the executable, where an installed Sinew has it; the scenes of the sources that this was built from.
std::filesystem::path catalogue_folder();

/// The names of its scenes, in alphabetical order.
std::vector<std::string> catalogue_names();

std::filesystem::path catalogue_path(const std::string& name);

} // namespace sinew::cli

#pragma once

#include <string>
#include <vector>

/// Index of the catalogue: name, description and category of every scene, without building the scenes.
namespace sinew::cli {

struct IndexEntry {
    std::string name, about, category, file;
};

/// All scenes by category, in the order of `Scene::categories`, then by name. Unreadable scenes are in the last
/// category.
std::vector<IndexEntry> catalogue_index();

} // namespace sinew::cli

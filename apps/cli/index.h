#pragma once

#include <string>
#include <vector>

/// What the files of the catalogue say they are, without reading more of them than that.
namespace sinew::cli {

struct IndexEntry {
    std::string name, about, category, file;
};

/// By category, in the order of `Scene::categories`; in one by name. What cannot be read is in the last.
std::vector<IndexEntry> catalogue_index();

} // namespace sinew::cli

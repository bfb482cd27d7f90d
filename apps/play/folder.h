#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sinew::play {

struct FolderEntry {
    std::string name;
    bool is_folder = false;
};

/// What a dialog offers of a folder: the folder above, folders, then files that end so, each in the order of the
/// alphabet; at most `most`. Empty where it cannot be read.
std::vector<FolderEntry> entries_of(const std::filesystem::path& folder, const std::string& ending,
                                    std::size_t most = 1000);

} // namespace sinew::play

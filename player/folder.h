#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sinew::play {

struct FolderEntry {
    std::string name;
    bool is_folder = false;
};

/// Entries of a folder for a dialog: the parent folder, then folders, then files with the given ending, each
/// alphabetically; at most `max` below the parent. Empty if unreadable.
std::vector<FolderEntry> entries_of(const std::filesystem::path& folder, const std::string& ending,
                                    std::size_t max = 1000);

} // namespace sinew::play

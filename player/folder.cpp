#include "player/folder.h"

#include <algorithm>
#include <tuple>

namespace sinew::play {

namespace fs = std::filesystem;

std::vector<FolderEntry> entries_of(const fs::path& folder, const std::string& ending, std::size_t max) {
    std::vector<FolderEntry> entries;
    std::error_code unknown;
    for (fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, unknown), end; !unknown && at != end;
         at.increment(unknown)) {
        auto name = at->path().filename().string();
        if (name.starts_with('.')) continue;
        std::error_code broken;
        const bool is_folder = at->is_directory(broken);
        if (is_folder || name.ends_with(ending)) entries.push_back({std::move(name), is_folder});
    }
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
        return std::tuple(!a.is_folder, a.name) < std::tuple(!b.is_folder, b.name);
    });
    if (entries.size() > max) entries.resize(max);
    if (!unknown && folder.has_parent_path() && folder.has_relative_path())
        entries.insert(entries.begin(), {"..", true});
    return entries;
}

} // namespace sinew::play

#pragma once

#include "tests/text_of.h"

#include <filesystem>
#include <stdlib.h>
#include <string>
#include <vector>

namespace sinew {

/// A folder of its own for a test, gone with it.
class ScratchFolder {
  public:
    ScratchFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "sinew-XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }

    std::filesystem::path operator/(const std::string& name) const { return path / name; }

    /// Names of all that lies in it, hidden files too.
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(path)) found.push_back(entry.path().filename());
        return found;
    }

    std::filesystem::path path;
};

} // namespace sinew

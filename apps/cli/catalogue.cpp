#include "apps/cli/catalogue.h"

#include <algorithm>
#include <cstdlib>

namespace sinew::cli {

namespace fs = std::filesystem;

fs::path catalogue_folder() {
    if (const char* const wanted = std::getenv("SINEW_SCENES"); wanted && *wanted) return wanted;
    std::error_code unknown;
    const auto installed = fs::read_symlink("/proc/self/exe", unknown).parent_path() / "../share/sinew/scenes";
    if (!unknown && fs::is_directory(installed, unknown)) return installed.lexically_normal();
    return SINEW_SCENES_DIR;
}

std::vector<std::string> catalogue_names() {
    std::vector<std::string> names;
    std::error_code missing;
    for (const auto& entry : fs::directory_iterator(catalogue_folder(), missing))
        if (entry.path().extension() == ".json") names.push_back(entry.path().stem());
    std::ranges::sort(names);
    return names;
}

fs::path catalogue_path(const std::string& name) {
    return catalogue_folder() / (name + ".json");
}

} // namespace sinew::cli

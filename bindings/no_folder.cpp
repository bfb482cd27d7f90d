// Files beside an imported one where there is no folder: on a page, and in the C face.
#include "files/in/folder_file.h"

namespace sinew::files {

std::optional<std::string> file_in_folder(const std::filesystem::path&, std::size_t) {
    return std::nullopt;
}

} // namespace sinew::files

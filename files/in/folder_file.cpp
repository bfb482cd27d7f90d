#include "files/in/folder_file.h"

#include <fstream>

namespace sinew::files {

std::optional<std::string> file_in_folder(const std::filesystem::path& path, std::size_t max) {
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(path, unknown)) return std::nullopt;
    std::ifstream stream(path, std::ios::binary);
    if (!stream) return std::nullopt;
    std::string bytes(max, '\0');
    stream.read(bytes.data(), std::streamsize(bytes.size()));
    bytes.resize(std::size_t(stream.gcount()));
    return bytes;
}

} // namespace sinew::files

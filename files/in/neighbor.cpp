#include "files/in/neighbor.h"

#include "sinew/scene/text.h"

#include <cstring>
#include <fstream>

namespace sinew::files {

std::string bytes_beside(const ImportFile& file, const std::string& name, const std::string& place) {
    namespace fs = std::filesystem;
    const fs::path path(name);
    bool is_below = !name.empty() && path.is_relative();
    for (const auto& part : path) is_below &= part != "..";
    if (!is_below || file.folder.empty())
        throw ImportError{place,
                          concat("it refers to ", in_quotes(name), ": only files in its own folder or below are read"),
                          "move that file beside it"};
    std::error_code unknown;
    if (!fs::is_regular_file(file.folder / path, unknown))
        throw ImportError{place, concat("it refers to ", in_quotes(name), ", which is not beside it")};
    std::ifstream stream(file.folder / path, std::ios::binary);
    std::string bytes(ImportLimits::bytes + 1, '\0');
    stream.read(bytes.data(), std::streamsize(bytes.size()));
    bytes.resize(std::size_t(stream.gcount()));
    if (bytes.size() > ImportLimits::bytes)
        throw ImportError{place, concat(in_quotes(name), " has more than ", ImportLimits::bytes, " bytes")};
    return bytes;
}

} // namespace sinew::files

#include "files/in/neighbor.h"

#include "sinew/scene/text.h"

#include "files/in/folder_file.h"

namespace sinew::files {
namespace {

/// The file of that path at hand, or the one of its last part: files that are dropped on a page have no folder.
const SideFile* find_given(const ImportFile& file, const std::string& name) {
    const auto last = std::string_view(name).substr(name.find_last_of('/') + 1); // npos + 1 is 0
    const SideFile* found = nullptr;
    for (const auto& given : file.beside) {
        if (given.name == name) return &given;
        if (given.name == last) found = &given;
    }
    return found;
}

} // namespace

std::string bytes_beside(const ImportFile& file, const std::string& name, const std::string& place) {
    const std::filesystem::path path(name);
    bool is_below = !name.empty() && path.is_relative();
    for (const auto& part : path) is_below &= part != "..";
    const auto refers = [&] { return concat("it refers to ", in_quotes(name)); };
    if (!is_below)
        throw ImportError{place, concat(refers(), ": only files in its own folder or below are read"),
                          "move that file beside it"};
    const auto* const given = find_given(file, name);
    auto bytes = given                 ? std::optional(given->bytes)
                 : file.folder.empty() ? std::nullopt
                                       : file_in_folder(file.folder / path, ImportLimits::bytes + 1);
    if (!bytes) throw ImportError{place, concat(refers(), ", which is not beside it"), "bring both files together"};
    if (bytes->size() > ImportLimits::bytes)
        throw ImportError{place, concat(in_quotes(name), " has more than ", ImportLimits::bytes, " bytes")};
    return std::move(*bytes);
}

} // namespace sinew::files

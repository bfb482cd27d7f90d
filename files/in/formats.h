#pragma once

#include "files/in/import.h"

#include <span>

namespace sinew::files {

/// A format that can be imported.
struct ImportFormat {
    std::string_view name;
    std::string_view endings; ///< of file names, separated by blanks
    std::string_view about;
    bool (*sniff)(std::string_view bytes); ///< true for content that can be of no other format
    Imported (*read)(const ImportFile&, const ImportOptions&);
};

/// Readers, one a file. A new format is one file and one line in the list of formats.cpp.
namespace reader {
extern const ImportFormat svg, png, obj, glb, gltf, tiled, points_and_sticks;
} // namespace reader

std::span<const ImportFormat* const> import_formats();

/// True for a file of another program, by its content or by an ending that no scene has.
bool is_foreign(const ImportFile& file);

} // namespace sinew::files

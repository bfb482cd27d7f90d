#pragma once

#include "files/in/formats.h"

#include <filesystem>
#include <string>

namespace sinew::cli {

/// A file of another program, read whole; of one beyond the limit so much that it is refused.
files::ImportFile read_import(const std::filesystem::path& path);
/// Writes a scene and the files beside it.
void write_import(const files::Imported& imported, const std::filesystem::path& target);

/// Writes the notes, a line each.
void write_import_notes(const files::Imported& imported, const std::filesystem::path& file,
                        const std::filesystem::path& target);

/// "3 figures, 1 collider, 2 files beside it"
std::string import_counts(const files::Imported& imported);
/// "logo.svg:12:3: note: <text> is not taken"
std::string import_note(const std::filesystem::path& path, const files::Note& note);

/// Imports; a fault of the file is a CommandError.
files::Imported import_of(const files::ImportFile& file, const files::ImportOptions& options);

} // namespace sinew::cli

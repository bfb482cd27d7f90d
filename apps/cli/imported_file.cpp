#include "apps/cli/imported_file.h"

#include "sinew/scene/text.h"

#include "apps/cli/console.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>

namespace sinew::cli {
namespace {

namespace fs = std::filesystem;

/// The whole file; of one beyond the limit so much that it is refused.
std::string read_bytes(const fs::path& path) {
    std::error_code unknown;
    if (fs::is_directory(path, unknown)) refuse(path.string(), "a folder, not a file");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) refuse(path.string(), std::strerror(errno));
    std::string bytes(files::ImportLimits::bytes + 1, '\0');
    stream.read(bytes.data(), std::streamsize(bytes.size()));
    bytes.resize(std::size_t(stream.gcount()));
    return bytes;
}

void write_file(const fs::path& path, const std::string& bytes) {
    std::error_code failure;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), failure);
    std::ofstream stream(path, std::ios::binary);
    stream.write(bytes.data(), std::streamsize(bytes.size()));
    stream.close();
    if (failure || !stream)
        refuse(path.string(), concat("cannot be written: ", failure ? failure.message() : std::strerror(errno)));
}

} // namespace

files::ImportFile read_import(const fs::path& path) {
    return {path.string(), files::title_of(path.filename().string()), read_bytes(path),
            path.has_parent_path() ? path.parent_path() : fs::path(".")};
}

void write_import(const files::Imported& imported, const fs::path& target) {
    for (const auto& side : imported.beside) write_file(target.parent_path() / side.name, side.bytes);
    write_file(target, json::to_text(imported.scene) + "\n");
}

void write_import_notes(const files::Imported& imported, const fs::path& file, const fs::path& target) {
    std::string text;
    for (const auto& note : imported.notes) text += import_note(file, note) + '\n';
    write_file(target, text);
}

std::string import_counts(const files::Imported& imported) {
    const auto number = [&](std::string_view key) {
        const auto* const list = json::find(imported.scene, key);
        return list ? list->value.as<json::Array>()->size() : 0;
    };
    auto text = fmt::format("{}, {}", count_of(number("figures"), "figure"), count_of(number("colliders"), "collider"));
    if (!imported.beside.empty()) text += fmt::format(", {} beside it", count_of(imported.beside.size(), "file"));
    return text;
}

std::string import_note(const fs::path& path, const files::Note& note) {
    return fmt::format("{}{}{}: note: {}", path.string(), note.place.empty() ? "" : ":", note.place,
                       printable(note.message, 400));
}

files::Imported import_of(const files::ImportFile& file, const files::ImportOptions& options) {
    try {
        return files::import_file(file, options);
    } catch (const files::ImportError& problem) {
        refuse(concat(file.name, problem.place.empty() ? "" : ":", problem.place), problem.message, problem.help);
    }
}

} // namespace sinew::cli

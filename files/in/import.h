#pragma once

#include "sinew/scene/json.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Files of other programs as scenes.
namespace sinew::files {

/// Something that a scene cannot hold, or holds otherwise than the file.
struct Note {
    std::string place; ///< line and column, or path, in the file; empty for the file as a whole
    std::string message;
};

/// A file that a scene refers to: a model, an image.
struct SideFile {
    std::string name; ///< path from the scene's folder
    std::string bytes;
};

/// Reason why a file cannot be imported; thrown by all readers.
struct ImportError {
    std::string place; ///< as in a note
    std::string message;
    std::string help{};
};

struct ImportOptions {
    std::string role{};            ///< role of whatever has none of its own; empty: that of the format
    std::optional<double> error{}; ///< largest distance of a simplified outline from the drawn one, pixels
    std::optional<double> scale{}; ///< length in the scene of one unit of the file; the format's if left out
};

/// A file to import. Files that it refers to (buffers, tilesets) are given beside it, or read from its folder.
struct ImportFile {
    std::string name;  ///< in messages
    std::string title; ///< of figures and side files: "logo"
    std::string bytes;
    std::filesystem::path folder{}; ///< empty: nothing is read from a folder
    std::vector<SideFile> beside{}; ///< files at hand, by their names or paths
};

struct Imported {
    json::Object scene;
    std::vector<Note> notes;
    std::vector<SideFile> beside;
};

/// Limits on the files that are read; all are checked before memory is taken.
struct ImportLimits {
    static constexpr std::size_t bytes = 16'000'000; ///< of a file, and of a file beside it
    static constexpr std::size_t depth = 64;         ///< nested elements, groups, nodes
    static constexpr std::size_t shapes = 2000;      ///< figures and colliders made of one file
    static constexpr std::size_t corners = 400;      ///< of a figure's outlines, once simplified
    static constexpr std::size_t particles = 10'000; ///< of all 2D figures
    static constexpr std::size_t points = 100'000;   ///< of a drawn outline, of a mesh
    static constexpr std::size_t notes = 1000;       ///< then the rest is counted
};

/// Name for figures and files, of a file's name: its stem in letters, digits, _ and -.
std::string title_of(std::string_view file_name);

/// Imports a file as a scene. The format is chosen by content, or else by the ending of the name. Throws ImportError.
Imported import_file(const ImportFile& file, const ImportOptions& options = {});

} // namespace sinew::files

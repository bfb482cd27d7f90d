#pragma once

#include "sinew/scene/scene.h"

#include "apps/cli/watched_files.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace sinew::cli {

/// Finds, reads and builds a scene. `word`: path of a file, name in the catalogue, or - for standard input, which is
/// read once and cached. Throws CommandError with all diagnostics. `read` collects the scene's file, images and models,
/// even if missing.
Opened open_file(const std::string& word, std::span<const Override> overrides = {}, WatchedFiles* read = nullptr);

/// Builds a scene from text, called `name` in messages; images and models are looked up in `folder`.
Opened open_text(const std::string& text, const std::string& name, const std::filesystem::path& folder,
                 std::span<const Override> overrides = {});

/// The file as read, unchecked; errors are in the document's diagnostics.
Document open_document(const std::string& word, std::span<const Override> overrides = {});

/// Path of the scene's file; empty for standard input. Throws CommandError if no scene has the name.
std::filesystem::path scene_path(const std::string& word);

/// Reads a text file of at most `max` bytes. Throws CommandError.
std::string read_text(const std::filesystem::path& path, std::size_t max);

/// Base name of files made from the scene: "ragdoll", "mine", "scene".
std::string title_of(const std::string& word);

} // namespace sinew::cli

#pragma once

#include "sinew/scene/scene.h"

#include "apps/cli/watched_files.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace sinew::cli {

/// Finds, reads and builds a scene: `word` is the path of a file, the name of one of the catalogue, or - for standard
/// input, which is read once and stays the same. Throws GiveUp with all that is wrong with it. Files that are read are
/// noted in `read`: the scene, its images and its models, those that cannot be opened among them.
Opened open_file(const std::string& word, std::span<const Override> overrides = {}, WatchedFiles* read = nullptr);

/// Builds a scene from its text, which messages call `name`; pictures and models are looked for in the folder.
Opened open_text(const std::string& text, const std::string& name, const std::filesystem::path& folder);

/// The file as it is, unchecked; what is wrong with it is in its diagnostics.
Document open_document(const std::string& word, std::span<const Override> overrides = {});

/// The scene's file; none for standard input. Throws GiveUp where no scene has that name.
std::filesystem::path scene_path(const std::string& word);

/// A text file, of at most so many bytes. Throws GiveUp.
std::string read_text(const std::filesystem::path& path, std::size_t most);

/// What files made of the scene are called: "ragdoll", "mine", "scene".
std::string title_of(const std::string& word);

} // namespace sinew::cli

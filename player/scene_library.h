#pragma once

#include "sinew/scene/document.h"
#include "sinew/scene/scene.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sinew::play {

/// An opened scene, or the reason of failure.
struct Fetched {
    std::optional<Opened> opened;
    std::string problem;
    std::filesystem::path path; ///< the scene's file, watched for changes; empty if none
};

/// The source of scenes.
struct SceneLibrary {
    std::vector<std::string> names;      ///< scenes of the catalogue, in display order
    std::vector<std::string> categories; ///< category of each name; empty if unknown
    std::function<Fetched(const std::string& word, std::span<const Override> overrides)> fetch;
    /// Opens a scene from its text, called `name` in messages; paths of pictures and models are relative to the file
    /// `beside`, or to the current folder if empty.
    std::function<Fetched(const std::string& text, const std::string& name, const std::filesystem::path& beside)> read;
};

} // namespace sinew::play

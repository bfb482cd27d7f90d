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

/// A scene that was opened, or all that is wrong with it.
struct Fetched {
    std::optional<Opened> opened;
    std::string problem;
    std::filesystem::path path; ///< where it is, to see when it changes; empty where it is no file
};

/// Where scenes come from.
struct Shelf {
    std::vector<std::string> names;      ///< of the catalogue, in the order in which they are shown
    std::vector<std::string> categories; ///< of each; none where that is not known
    std::function<Fetched(const std::string& word, std::span<const Override> overrides)> fetch;
    /// Opens a scene from its text, which messages call `name`; pictures and models are looked for beside the file
    /// `beside`, or in the current folder where that is empty.
    std::function<Fetched(const std::string& text, const std::string& name, const std::filesystem::path& beside)> read;
};

} // namespace sinew::play

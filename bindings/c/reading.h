#pragma once

#include "sinew/scene/scene.h"

#include "bindings/c/sinew.h"

#include <optional>
#include <string>
#include <vector>

namespace sinew::c {

/// Options of the caller, copied: players open a scene again in another mode.
struct SceneFile {
    std::string text, name;
    std::vector<Override> overrides;
    std::vector<std::pair<std::string, std::array<int, 2>>> images; ///< width and height, pixels
    std::vector<std::pair<std::string, std::string>> models;        ///< texts

    /// SINEW_BAD_ARGUMENT for null pointers inside.
    static sinew_status read(const char* text, const sinew_open_options* options, SceneFile& file);

    /// Opens the scene and keeps its diagnostics for the thread (failure.h).
    std::optional<Opened> open(std::span<const Override> with) const;
    std::optional<Opened> open() const { return open(overrides); }
};

} // namespace sinew::c

#pragma once

#include "sinew/scene/document.h"
#include "sinew/scene/scene.h"
#include "sinew/session/session.h"

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sinew::files {
class Exporter;
}

namespace sinew::play {

/// An opened scene, or the reason of failure.
struct Fetched {
    std::optional<Opened> opened;
    std::string problem;
    std::filesystem::path path;     ///< the scene's file, watched for changes; empty if none
    std::shared_ptr<Level> level{}; ///< code beside the scene
};

/// Session of a scene that was opened, with the code beside it.
inline Session session_from(Fetched fetched) {
    Session session(std::move(*fetched.opened));
    if (fetched.level) session.play(std::move(fetched.level));
    return session;
}

/// A scene file made of another program's file, or the reason why none was. Both empty: it is no such file.
struct Converted {
    std::filesystem::path scene;
    std::string problem;
    std::string message; ///< contents of the scene, and the parts not taken
};

/// The source of scenes, and other programs' files in and out.
struct SceneLibrary {
    std::vector<std::string> names;      ///< scenes of the catalogue, in display order
    std::vector<std::string> categories; ///< category of each name; empty if unknown
    std::function<Fetched(const std::string& word, std::span<const Override> overrides)> fetch;
    /// Opens a scene from its text, called `name` in messages; paths of pictures and models are relative to the file
    /// `beside`, or to the current folder if empty.
    std::function<Fetched(const std::string& text, const std::string& name, const std::filesystem::path& beside)> read;
    std::function<Converted(const std::filesystem::path& file)> convert{}; ///< empty: no file of another program
    /// Begins an export of frames of that size, in pixels, and rate, or of a moment (0); null for an ending that is
    /// none of an export's, and of pictures.
    std::function<std::unique_ptr<files::Exporter>(const std::filesystem::path& path, std::array<int, 2> size,
                                                   double fps)>
        open_export{};
};

} // namespace sinew::play

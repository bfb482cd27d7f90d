#pragma once

#include "sinew/math/color.h"
#include "sinew/session/session.h"

#include "canvas/failure.h"

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sinew::files {

using canvas::Failure;

/// Receiver of finished files.
using TakeFile = std::function<Failure(const std::filesystem::path& path, std::string_view bytes)>;

/// Writes a file to disk, complete or not at all; replaces an existing one.
[[nodiscard]] Failure write_file(const std::filesystem::path& path, std::string_view bytes);

/// Wishes for a file, whatever its format.
struct ExportRequest {
    std::filesystem::path path;         ///< of one file, or with a %d or %04d for the number of the frame
    double fps = 30;                    ///< frames per second
    std::vector<std::string> figures{}; ///< names, of those that are written alone; empty: everything
    std::array<int, 2> size{640, 480};  ///< pixels, of formats that are pictures
    std::optional<Color> background{};  ///< of pictures; nothing: the scene's
    std::string follow{};               ///< figure in the middle of pictures; empty: the scene's view
    std::string caption{};              ///< line of text at the bottom of pictures; empty: none
    /// By which a motion may be off between its keys: pixels of vectors, millimetres of models; nothing: the format's.
    std::optional<double> tolerance{};
    std::size_t joints = 0;     ///< of a .glb: so many carry a moving mesh, for engines; 0: a morph target a key
    TakeFile take = write_file; ///< of models and vectors; pictures and films are written to disk
};

/// Names of the figures that a request asks for.
std::vector<std::string> figures_named(const ExportRequest& request);
/// True if a figure of the session has this name.
bool has_figure(const Session& session, const std::string& name);

/// An export under way. Files appear complete under their final names or not at all; failures are worded for whoever
/// asked for the file.
class Exporter {
  public:
    Exporter() = default;
    Exporter(const Exporter&) = delete;
    Exporter& operator=(const Exporter&) = delete;
    virtual ~Exporter() = default;

    /// Adds the session's present moment as the next frame.
    [[nodiscard]] virtual Failure frame(const Session& session) = 0;
    /// Completes all files, after one frame or more.
    [[nodiscard]] virtual Failure finish() = 0;

    /// Files written so far.
    const std::vector<std::filesystem::path>& written() const { return written_; }
    /// Sentences about what the format could not take.
    const std::vector<std::string>& notes() const { return notes_; }

  protected:
    std::vector<std::filesystem::path> written_;
    std::vector<std::string> notes_;
};

} // namespace sinew::files

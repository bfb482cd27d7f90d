#pragma once

#include "sinew/picture/picture.h"
#include "sinew/session/session.h"

#include "canvas/writer.h"
#include "files/out/exporter.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace sinew::play {

/// A recording at a constant rate, written to a file: pictures of one size, or an export of the session. Methods that
/// can fail return the reason.
class Film {
  public:
    static constexpr double rate = 30; ///< frames per second

    Film() = default;
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;
    /// An unfinished film is finished, to be playable.
    ~Film();

    std::optional<std::string> begin(std::filesystem::path path, int width, int height);
    void begin(std::filesystem::path path, std::unique_ptr<files::Exporter> exporter);
    std::optional<std::string> finish();
    bool recording() const { return writer_ || exporter_; }
    const std::filesystem::path& path() const { return path_; } ///< of the last film

    void advance(double seconds) { due_ -= seconds; }
    bool wants_frame() const { return recording() && due_ <= 0; }
    bool fits(const Picture& picture) const {
        return exporter_ || (picture.width == width_ && picture.height == height_);
    }
    /// Writes the frames due, all of this moment. A failure ends the recording.
    std::optional<std::string> add(const Session& session, const Picture& picture);

  private:
    std::unique_ptr<canvas::Writer> writer_;
    std::unique_ptr<files::Exporter> exporter_; ///< in place of the writer
    std::filesystem::path path_;
    int width_ = 0, height_ = 0; ///< pixels
    double due_ = 0;             ///< seconds until the next frame
};

} // namespace sinew::play

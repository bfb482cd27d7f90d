#pragma once

#include "sinew/picture/picture.h"

#include "canvas/writer.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace sinew::play {

/// A recording: pictures of one size at a constant rate, written to a file. Methods that can fail return the reason.
class Film {
  public:
    static constexpr double rate = 30; ///< frames per second

    Film() = default;
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;
    /// An unfinished film is finished, to be playable.
    ~Film();

    std::optional<std::string> begin(std::filesystem::path path, int width, int height);
    std::optional<std::string> finish();
    bool recording() const { return writer_ != nullptr; }
    const std::filesystem::path& path() const { return path_; } ///< of the last film

    void advance(double seconds) { due_ -= seconds; }
    bool wants_frame() const { return recording() && due_ <= 0; }
    bool fits(const Picture& picture) const { return picture.width == width_ && picture.height == height_; }
    /// Writes the frames due, all of this picture. A failure ends the recording.
    std::optional<std::string> add(const Picture& picture);

  private:
    std::unique_ptr<canvas::Writer> writer_;
    std::filesystem::path path_;
    int width_ = 0, height_ = 0; ///< pixels
    double due_ = 0;             ///< seconds until the next frame
};

} // namespace sinew::play

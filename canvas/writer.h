#pragma once

#include "sinew/picture/picture.h"

#include "canvas/failure.h"
#include "canvas/partial_file.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace sinew::canvas {

/// Properties common to all frames of a file.
struct FrameFormat {
    int width = 640;  ///< pixels
    int height = 480; ///< pixels
    double fps = 60;  ///< frames per second; ignored by still images
    /// WebP only: half the file size, for more time and memory proportional to the length; meant for short films.
    bool compact = false;
    /// Name of the file in messages; empty: the path.
    std::string called = {};
};

/// A file of pictures. The file appears under the final name at finish(), complete, or not at all: a writer that fails,
/// is interrupted, or is destroyed before finish() leaves nothing behind. After a failure every call returns the same
/// failure.
class Writer {
  public:
    Writer(std::filesystem::path target, const FrameFormat& format);
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    virtual ~Writer() = default;

    /// Creates the file. Called once, first; functions that open writers have already called begin().
    [[nodiscard]] Failure begin();

    /// Adds a frame. A picture of another size is scaled to fit.
    [[nodiscard]] Failure frame(const Picture& picture);

    /// Completes the file.
    [[nodiscard]] Failure finish();

  protected:
    /// Steps of a file format. All write to partial.path() and return the bare reason of a failure. Naming and cleaning
    /// up are left to Writer, except that abandon() stops whatever still writes.
    virtual Failure start() = 0;
    virtual Failure add(const Picture& picture) = 0;
    virtual Failure complete() = 0;
    virtual void abandon() = 0;

    const std::filesystem::path target;
    const FrameFormat format;
    PartialFile partial;
    std::size_t frames = 0; ///< added so far

  private:
    Failure settle(const Failure& failure);
    std::string name() const { return format.called.empty() ? target.string() : format.called; }

    Failure settled; ///< reason why no more calls are accepted
};

/// A writer, or the reason why there is none.
struct Opened {
    std::unique_ptr<Writer> writer;
    Failure failure;
};

/// Calls begin() on a new writer.
Opened begun(std::unique_ptr<Writer> writer);

} // namespace sinew::canvas

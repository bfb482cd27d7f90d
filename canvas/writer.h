#pragma once

#include "sinew/session/picture.h"

#include "canvas/failure.h"
#include "canvas/partial_file.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

namespace sinew::canvas {

/// What every frame of a file has in common.
struct FrameFormat {
    int width = 640;  ///< pixels
    int height = 480; ///< pixels
    double fps = 60;  ///< frames a second; of no meaning to a still image
    /// A WebP that is half as large, in memory that grows with its length and more time: for short ones.
    bool compact = false;
    /// What messages call the file, where its own name would tell nobody anything; empty: its path.
    std::string called = {};
};

/// A file that pictures are written to. It appears under its name at finish(), whole, or not at all: a writer that
/// failed, was interrupted, or is destroyed before finish() leaves nothing behind. After a failure every call returns
/// it again.
class Writer {
  public:
    Writer(std::filesystem::path target, const FrameFormat& format);
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    virtual ~Writer() = default;

    /// Creates the file. Called once, first; the functions that open writers have called it.
    [[nodiscard]] Failure begin();

    /// Adds a frame. A picture of another size is scaled to fit.
    [[nodiscard]] Failure frame(const Picture& picture);

    /// Completes the file.
    [[nodiscard]] Failure finish();

  protected:
    /// The steps, as a kind of file does them. All write to partial.path(), and give the bare reason of a failure.
    /// Naming and cleaning up is not their concern, except that abandon() lets go of whatever still writes.
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

    Failure settled; ///< why no more is accepted
};

/// Either a writer or the reason why there is none.
struct Opened {
    std::unique_ptr<Writer> writer;
    Failure failure;
};

/// Begins a writer.
Opened begun(std::unique_ptr<Writer> writer);

} // namespace sinew::canvas

#pragma once

#include "sinew/picture/draw.h"

#include "apps/cli/stage.h"
#include "canvas/writer.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

/// Rendering of a stage's frames into a file: number, times and size.
namespace sinew::cli {

/// Requested frames, as far as options are given.
struct Wishes {
    std::optional<double> seconds, fps, at;
    std::optional<std::array<int, 2>> size, sheet;
};

/// Times of a file's frames, seconds.
struct Frames {
    double first = 0;
    double between = 0;
    std::size_t count = 1;
    double end = first;

    double time(std::size_t frame) const { return first + between * double(frame); }
};

/// A file in progress.
struct Shooting {
    std::unique_ptr<canvas::Writer> writer;
    Frames frames;
    std::array<int, 2> one{};     ///< pixels of a single picture
    std::array<int, 2> whole{};   ///< pixels of a frame: several pictures beside each other
    std::array<int, 2> written{}; ///< pixels of a frame in the file, with padding
};

/// Begins the file at `path`, called `called` in messages. Throws CommandError.
Shooting begin_file(const std::filesystem::path& path, const std::string& called, const Wishes& wishes,
                    const Stage& stage);

/// Draws and writes all frames, with a progress bar. Throws CommandError.
void write_frames(Shooting& shooting, Stage& stage, OverlaySet overlay, const std::string& label);

/// "a.mp4: 30 frames of 64x48 from 0 to 0.5 s, 4 kB"
std::string written_text(const std::string& called, const Shooting& shooting, std::uintmax_t bytes);

} // namespace sinew::cli

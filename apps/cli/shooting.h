#pragma once

#include "apps/cli/stage.h"
#include "canvas/writer.h"

#include <array>
#include <memory>
#include <optional>
#include <string>

/// Frames of a stage into a file: how many, when, how large.
namespace sinew::cli {

/// What is asked for, as far as options say it.
struct Wishes {
    std::optional<double> seconds, fps, at;
    std::optional<std::array<int, 2>> size, sheet;
};

/// Times, in seconds, of the frames of a file.
struct Frames {
    double first = 0;
    double between = 0;
    std::size_t count = 1;
    double end = first;

    double time(std::size_t frame) const { return first + between * double(frame); }
};

/// A file that was begun, and what goes into it.
struct Shooting {
    std::unique_ptr<canvas::Writer> writer;
    Frames frames;
    std::array<int, 2> one{};     ///< pixels of one picture
    std::array<int, 2> whole{};   ///< of a frame: several beside each other
    std::array<int, 2> written{}; ///< of a frame in the file
};

/// Begins the file at `path`, which messages call `called`. Throws GiveUp.
Shooting begin_file(const std::filesystem::path& path, const std::string& called, const Wishes& wishes,
                    const Stage& stage);

/// Draws and writes all frames, with a progress bar. Throws GiveUp.
void write_frames(Shooting& shooting, Stage& stage, OverlaySet overlay, const std::string& label);

/// "a.mp4: 30 frames of 64x48 from 0 to 0.5 s, 4 kB"
std::string written_text(const std::string& called, const Shooting& shooting, std::uintmax_t bytes);

} // namespace sinew::cli

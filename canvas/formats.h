#pragma once

#include "canvas/writer.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace sinew::canvas {

/// A file format for pictures.
struct Format {
    std::string_view extension; ///< with the dot, in lower case
    std::string_view about;     ///< a line of help
    bool moves;                 ///< true: many frames; false: one
    double usual_fps;           ///< frames per second by default
    int longest_side;           ///< pixels
    int side_multiple;          ///< pixels: sides are padded to multiples
    Failure (*fps_problem)(double fps);
    Opened (*open)(const std::filesystem::path&, const FrameFormat&);
};

/// All formats. Help texts, checks and open() walk this list.
std::span<const Format> formats();

/// Largest number of pixels of a picture: 8192 x 8192, a quarter of a gigabyte of memory.
inline constexpr long max_pixels = 1L << 26;

/// Extension with the dot, in lower case.
std::string extension_of(const std::filesystem::path& path);

/// Format named by the extension (in any case), or null.
const Format* format_of(const std::filesystem::path& path);

/// Reason why a file cannot be written in this format: unknown extension (the message names the valid ones and the
/// nearest), a size that is not positive or over the limits, a frame rate the format cannot represent.
[[nodiscard]] Failure check(const std::filesystem::path& path, const FrameFormat& format);

/// Opens a file by extension: checks the format, creates missing folders, starts ffmpeg if needed. An existing file is
/// replaced at finish().
Opened open(const std::filesystem::path& path, const FrameFormat& format);

/// Length of a side of `side` pixels after padding.
int padded(int side, const Format& format);

/// Reason why a size is not possible with sides up to `longest_side` pixels. The message begins with the first argument
/// ("a .gif").
[[nodiscard]] Failure size_problem(const std::string& what, long width, long height, int longest_side);

} // namespace sinew::canvas

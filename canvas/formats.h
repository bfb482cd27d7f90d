#pragma once

#include "canvas/writer.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace sinew::canvas {

/// A kind of file that pictures can be written to.
struct Format {
    std::string_view extension; ///< with its dot, in lower case
    std::string_view about;     ///< one line of help
    bool moves;                 ///< many frames, or one
    double usual_fps;           ///< what to take where nothing is asked for
    int longest_side;           ///< pixels
    int side_multiple;          ///< pixels: sides are padded to multiples of it
    Failure (*fps_problem)(double fps);
    Opened (*open)(const std::filesystem::path&, const FrameFormat&);
};

/// All of them. Help texts, checks and open() walk this list.
std::span<const Format> formats();

/// A picture has at most this many pixels: 8192 x 8192 fit, a quarter of a gigabyte of memory.
inline constexpr long most_pixels = 1L << 26;

/// The extension with its dot, in lower case.
std::string extension_of(const std::filesystem::path& path);

/// The format that the extension names (in any case), or null.
const Format* format_of(const std::filesystem::path& path);

/// What is wrong with writing this path in this format: unknown extension (names the valid ones and the nearest), a
/// size that is not positive or over the limits, frames a second that the format cannot keep.
[[nodiscard]] Failure check(const std::filesystem::path& path, const FrameFormat& format);

/// Opens a file by its extension: checks, creates missing folders, starts ffmpeg where it is needed. An existing file
/// is replaced at finish().
Opened open(const std::filesystem::path& path, const FrameFormat& format);

/// How long a side of that many pixels is in a file of that format.
int padded(int side, const Format& format);

/// What is wrong with this size, where no side may be longer than `longest_side`. `what` begins the message ("a .gif").
[[nodiscard]] Failure size_problem(const std::string& what, long width, long height, int longest_side);

} // namespace sinew::canvas

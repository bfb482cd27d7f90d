#include "canvas/formats.h"

#include "canvas/image.h"
#include "canvas/movie.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>
#include <vector>

namespace sinew::canvas {
namespace {

namespace fs = std::filesystem;

Failure any_fps(double) {
    return {};
}

Failure movie_fps(double fps) {
    if (fps >= 1 && fps <= 240) return {};
    return fmt::format("{:g} frames a second cannot be; use 1 to 240", fps);
}

/// GIF frame delays are whole hundredths of a second, and viewers slow down a delay of 1.
Failure gif_fps(double fps) {
    const double delay = 100 / fps;
    if (fps >= 1 && delay >= 2 && delay == std::round(delay)) return {};
    return fmt::format(
        "a .gif counts time in hundredths of a second and cannot keep {:g} frames a second; use 50, 25, 20 or 10", fps);
}

constexpr std::array<Format, 7> list{{
    {".png", "one picture, or a contact sheet", false, 0, 16384, 1, any_fps, open_image},
    {".svg", "one picture as vectors", false, 0, 16384, 1, any_fps, open_image},
    {".pdf", "one picture as vectors, a page of its size", false, 0, 16384, 1, any_fps, open_image},
    {".gif", "a looping animation, 256 colours", true, 25, 8192, 1, gif_fps, open_gif},
    {".mp4", "a film (H.264)", true, 60, 8192, even, movie_fps, open_mp4},
    {".webp", "a looping animation, all colours", true, 30, 8192, 1, movie_fps, open_webp},
    {".webm", "a film for browsers (VP9)", true, 60, 8192, even, movie_fps, open_webm},
}};

/// Levenshtein distance: number of letters to insert, remove or replace (1965).
std::size_t edits_between(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t(0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i + 1);
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

std::string unknown_extension(const fs::path& path) {
    const std::string found = extension_of(path);
    std::string message = path.string() + ": " + (found.empty() ? "no extension" : "unknown extension " + found);
    const auto distance = [&](const Format& f) { return edits_between(found, f.extension); };
    const Format& nearest = *std::ranges::min_element(list, {}, distance);
    if (2 * distance(nearest) < found.size()) message += "; did you mean " + std::string(nearest.extension) + "?";
    message += " (possible are";
    for (const Format& f : list) message += (&f == &list[0] ? " " : ", ") + std::string(f.extension);
    return message + ")";
}

} // namespace

std::string extension_of(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return extension;
}

std::span<const Format> formats() {
    return list;
}

const Format* format_of(const fs::path& path) {
    const auto found = std::ranges::find(list, extension_of(path), &Format::extension);
    return found == list.end() ? nullptr : &*found;
}

int padded(int side, const Format& format) {
    return (side + format.side_multiple - 1) / format.side_multiple * format.side_multiple;
}

Failure size_problem(const std::string& what, long width, long height, int longest_side) {
    if (width < 1 || height < 1) return fmt::format("a size of {}x{} has no pixels", width, height);
    if (width > longest_side || height > longest_side)
        return fmt::format("{}x{} is too large: {} has at most {} pixels a side", width, height, what, longest_side);
    if (width * height > max_pixels)
        return fmt::format("{}x{} is too large: a picture has at most {} pixels in all", width, height, max_pixels);
    return {};
}

Failure check(const fs::path& path, const FrameFormat& format) {
    const Format* kind = format_of(path);
    if (kind == nullptr) return unknown_extension(path);
    const std::string what = "a " + std::string(kind->extension);
    if (auto failure = size_problem(what, format.width, format.height, kind->longest_side)) return failure;
    return kind->fps_problem(format.fps);
}

Opened open(const fs::path& path, const FrameFormat& format) {
    if (auto failure = check(path, format)) return {nullptr, failure};
    return format_of(path)->open(path, format);
}

} // namespace sinew::canvas

#pragma once

#include "canvas/failure.h"

#include <cstddef>
#include <filesystem>

/// Names of a sequence of files: "cloth-%04d.obj" is cloth-0001.obj, cloth-0002.obj, ...
namespace sinew::files {

/// Reason why the name cannot be used: more than one %, or one that is not a number's.
canvas::Failure frame_number_problem(const std::filesystem::path& path);
/// True if the file's name has a place for the frame's number: %d, %3d or %04d.
bool has_frame_number(const std::filesystem::path& path);
/// The path of a frame, counted from 1 as Blender and ffmpeg do. "%%" is a plain percent sign.
std::filesystem::path frame_path(const std::filesystem::path& pattern, std::size_t number);

} // namespace sinew::files

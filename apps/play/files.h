#pragma once

#include "canvas/failure.h"

#include <filesystem>
#include <string>

namespace sinew::play {

/// When the file was written; the same for all that are not there.
std::filesystem::file_time_type time_written(const std::filesystem::path& path);

/// Writes a file whole, or not at all.
[[nodiscard]] canvas::Failure write_file(const std::filesystem::path& path, const std::string& text);

/// A name in the folder that no file has: ragdoll.png, ragdoll-2.png.
std::filesystem::path free_path(const std::filesystem::path& wanted);

} // namespace sinew::play

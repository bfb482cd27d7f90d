#pragma once

#include "canvas/failure.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace sinew::play {

/// When the file was written; the same for all that are not there.
std::filesystem::file_time_type time_written(const std::filesystem::path& path);

/// Writes a file whole, or not at all.
[[nodiscard]] canvas::Failure write_file(const std::filesystem::path& path, const std::string& text);

/// A name in the folder that no file has: ragdoll.png, ragdoll-2.png.
std::filesystem::path free_path(const std::filesystem::path& wanted);

/// The whole of a text file of at most so many bytes; nothing where it cannot be read.
std::optional<std::string> read_file(const std::filesystem::path& path, std::size_t most);

/// From the root, for messages: a reader shall find it.
std::string full_path(const std::filesystem::path& path);

} // namespace sinew::play

#pragma once

#include "canvas/failure.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace sinew::play {

/// Time of the last write; a fixed default for missing files.
std::filesystem::file_time_type time_written(const std::filesystem::path& path);

/// Writes a file as a whole or not at all; returns the failure, if any.
[[nodiscard]] canvas::Failure write_file(const std::filesystem::path& path, const std::string& text);

/// Removes a file; a missing one is no error.
void remove_file(const std::filesystem::path& path);

/// A path without a file yet: ragdoll.png, ragdoll-2.png.
std::filesystem::path free_path(const std::filesystem::path& wanted);

/// Content of a regular file of at most `max` bytes; nothing if unreadable.
std::optional<std::string> read_file(const std::filesystem::path& path, std::size_t max);

/// Absolute path, for messages.
std::string full_path(const std::filesystem::path& path);

} // namespace sinew::play

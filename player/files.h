#pragma once

#include "canvas/failure.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace sinew::play {

/// Time of the last write; a fixed default for missing files.
std::filesystem::file_time_type time_written(const std::filesystem::path& path);

/// Writes a file as a whole or not at all; returns the failure, if any.
[[nodiscard]] canvas::Failure write_file(const std::filesystem::path& path, const std::string& text);

/// Begins a file, and appends to it the arguments of the function: in one piece, and kept by the system whatever
/// ends the program. Calls return the failure, if any.
std::function<canvas::Failure(std::span<const std::byte>)> append_to(const std::filesystem::path& path);

/// Name of a new file in a folder, which is made; of files with the extension there, all but the latest `kept` are
/// removed. Empty if there can be no folder.
std::filesystem::path new_file_in(const std::filesystem::path& folder, const std::string& stem,
                                  const std::string& extension, std::size_t kept);

/// Removes a file; a missing one is no error.
void remove_file(const std::filesystem::path& path);

/// A path without a file yet: ragdoll.png, ragdoll-2.png.
std::filesystem::path free_path(const std::filesystem::path& wanted);

/// Content of a regular file of at most `max` bytes; nothing if unreadable.
std::optional<std::string> read_file(const std::filesystem::path& path, std::size_t max);

/// Absolute path, for messages.
std::string full_path(const std::filesystem::path& path);

} // namespace sinew::play

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

namespace sinew::files {

/// The first `max` bytes of a file; empty where there is no such file. The C face and pages have no files:
/// bindings/no_files.cpp.
std::optional<std::string> file_in_folder(const std::filesystem::path& path, std::size_t max);

} // namespace sinew::files

#pragma once

#include "sinew/scene/image.h"

#include <cstddef>
#include <filesystem>
#include <span>

namespace sinew::canvas {

/// Reads the PNG file at `path`: any colour type and depth, converted to 8 bits a channel. `name` stands for the file
/// in messages. Limits are checked against the header's size before decoding: a file of a few kilobytes cannot claim
/// gigabytes.
ReadImage read_png(const std::filesystem::path& path, const std::string& name, const Limits& limits);
/// The same for the content of a file.
ReadImage read_png(std::span<const std::byte> bytes, const std::string& name, const Limits& limits);

} // namespace sinew::canvas

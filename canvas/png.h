#pragma once

#include "sinew/scene/image.h"

#include <filesystem>

namespace sinew::canvas {

/// Reads the PNG file at `path`: any colour type and depth, given as 8 bits a channel. `name` is what messages call it.
/// Its size is known before its pixels are, so that a file of a few kilobytes cannot ask for gigabytes.
ReadImage read_png(const std::filesystem::path& path, const std::string& name, const Limits& limits);

} // namespace sinew::canvas

#pragma once

#include "canvas/writer.h"

namespace sinew::canvas {

/// A writer of one picture to a PNG, SVG or PDF.
Opened open_image(const std::filesystem::path& target, const FrameFormat& format);

} // namespace sinew::canvas

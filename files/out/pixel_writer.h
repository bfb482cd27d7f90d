#pragma once

#include "canvas/writer.h"

namespace sinew::files {

/// Opens a file of pixels with straight alpha, encoded by ffmpeg: .apng, .webm (VP9), .mov (ProRes 4444), or a .jpg,
/// which has one picture and no transparency.
canvas::Opened open_pixels(const std::filesystem::path& path, const canvas::FrameFormat& format);

} // namespace sinew::files

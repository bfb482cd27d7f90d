#pragma once

#include "canvas/writer.h"

namespace sinew::canvas {

/// Writers of movies. Frames are handed to ffmpeg as they come, so memory does not grow with length. Pictures are
/// opaque: what a background lets through is white.

/// H.264 with 4:2:0 colours has sides that are multiples of this.
inline constexpr int even = 2;

/// H.264, 4:2:0, colours tagged as BT.709, playable while it downloads. Sides are padded to even numbers with
/// background.
Opened open_mp4(const std::filesystem::path& target, const FrameFormat& format);

/// One palette for the whole film. It is known only after the last frame, so frames wait, compressed without loss, in a
/// file beside the target; a GIF's own delays are whole hundredths of a second: see fps_problem() in formats.h.
Opened open_gif(const std::filesystem::path& target, const FrameFormat& format);

/// Animated WebP that loops; of one frame, a still WebP.
Opened open_webp(const std::filesystem::path& target, const FrameFormat& format);

} // namespace sinew::canvas

#pragma once

#include "canvas/writer.h"

namespace sinew::canvas {

/// Writers of movies. Frames are handed to ffmpeg one by one, so memory does not grow with length. Pictures are opaque:
/// a transparent background is blended onto white.

/// Sides of H.264 with 4:2:0 chroma subsampling are multiples of this.
inline constexpr int even = 2;

/// H.264, 4:2:0, colours tagged as BT.709, playable while downloading. Sides are padded to even numbers with
/// background.
Opened open_mp4(const std::filesystem::path& target, const FrameFormat& format);

/// A looping GIF with one palette for the whole film. The palette is known only after the last frame, so frames wait,
/// losslessly compressed, in a file beside the target. Frame delays are whole hundredths of a second: see
/// Format::fps_problem.
Opened open_gif(const std::filesystem::path& target, const FrameFormat& format);

/// VP9, 4:2:0, colours tagged as BT.709: for browsers. Sides are padded to even numbers with background.
Opened open_webm(const std::filesystem::path& target, const FrameFormat& format);

/// Animated WebP that loops; of one frame, a still WebP.
Opened open_webp(const std::filesystem::path& target, const FrameFormat& format);

} // namespace sinew::canvas

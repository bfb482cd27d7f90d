#pragma once

#include "sinew/scene/limits.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew {

/// An image in memory: rows from top to bottom; a pixel is 0xAARRGGBB, its colour multiplied by its alpha.
struct Image {
    int width = 0;  ///< pixels
    int height = 0; ///< pixels
    std::vector<std::uint32_t> pixels;
    std::shared_ptr<const Image> half{}; ///< the same, half as wide and high, for where it is seen small; may be none
};

/// The image with a half, that with a half, and so on, down to a few pixels; each pixel the mean of four.
std::shared_ptr<const Image> with_halves(Image image);

/// An image that was read, or why there is none.
struct ReadImage {
    std::shared_ptr<const Image> image;
    std::string problem, help;
};

/// Finds and reads the image file that a scene names. Who opens a scene knows where its files are: `sinew/` reads none.
/// At most `limits.bytes` of it may be read, and at most `limits.pixels` be made of it.
using ImageReader = std::function<ReadImage(const std::string& name, const Limits& limits)>;

/// The images of a scene by the names it gives them, each once, in the order in which they are first named.
using Images = std::vector<std::pair<std::string, std::shared_ptr<const Image>>>;

} // namespace sinew

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

/// An image in memory: rows from top to bottom, pixels 0xAARRGGBB with premultiplied alpha.
struct Image {
    int width = 0;  ///< pixels
    int height = 0; ///< pixels
    std::vector<std::uint32_t> pixels;
    std::shared_ptr<const Image> half{}; ///< the next mipmap level, half as wide and high; may be null
};

/// Builds the mipmap chain of an image, down to a few pixels; each pixel is the mean of four.
std::shared_ptr<const Image> with_halves(Image image);

/// An image, or the reason why the file cannot be read.
struct ReadImage {
    std::shared_ptr<const Image> image;
    std::string problem, help;
};

/// Reads the image file that a scene names. The caller supplies this function: `sinew/` reads no files. The function
/// may read at most `limits.bytes` and return at most `limits.pixels` pixels.
using ImageReader = std::function<ReadImage(const std::string& name, const Limits& limits)>;

/// Images of a scene by the names in the scene, each once, in order of first use.
using Images = std::vector<std::pair<std::string, std::shared_ptr<const Image>>>;

} // namespace sinew

#pragma once

#include "sinew/math/vec.h"
#include "sinew/scene/image.h"

#include <array>
#include <string>

namespace sinew::files {

/// The image of opaque pixels that belong together, cut out of an image.
struct ImagePart {
    Image image;           ///< all other pixels are transparent
    int left = 0, top = 0; ///< where it was
    std::size_t pixels = 0;
};

/// Parts of an image whose pixels of at least half the opacity touch each other, the largest first.
std::vector<ImagePart> parts_of(const Image& image);

/// The part of an image in a quadrilateral, its corners going round from the top left, in pixels: mapped bilinearly.
Image cut_out(const Image& image, const std::array<Vec2<double>, 4>& corners);

/// Mean colour of the opaque pixels: #rrggbb.
std::string mean_color(const Image& image);

/// The image as a PNG file.
std::string png_bytes(const Image& image);

} // namespace sinew::files

#pragma once

#include "sinew/math/vec.h"
#include "sinew/scene/image.h"

#include <array>
#include <functional>
#include <string>

namespace sinew::files {

/// The image of opaque pixels that belong together, cut out of an image.
struct ImagePart {
    Image image;           ///< all other pixels are transparent
    int left = 0, top = 0; ///< where it was
    std::size_t pixels = 0;
};

/// Visits the parts of an image whose pixels of at least half the opacity touch each other along a side, the largest
/// first. Throws ImportError where their boxes cover the image more than four times.
void each_part(const Image& image, const std::function<void(const ImagePart&)>& visit);

/// The part of an image in a quadrilateral, its corners going round from the top left, in pixels: mapped bilinearly.
/// `density`: pixels of the part along a pixel of the image, at most 1.
Image cut_out(const Image& image, const std::array<Vec2<double>, 4>& corners, double density);

/// Mean colour of the opaque pixels: #rrggbb.
std::string mean_color(const Image& image);

} // namespace sinew::files

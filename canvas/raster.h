#pragma once

#include "sinew/picture/picture.h"

#include "canvas/cairo_handle.h"
#include "canvas/failure.h"

#include <cstddef>
#include <span>

namespace sinew::canvas {

/// A block of pixels into which pictures are painted one after the other, without allocating. Pixels are opaque: a
/// transparent background is blended onto white.
class Raster {
  public:
    /// A raster of `width` x `height` pixels. Further columns on the right and rows at the bottom (padding) carry only
    /// background.
    Raster(int width, int height, int padding_right = 0, int padding_bottom = 0);

    /// Paints the picture, scaled to fit if the sizes differ.
    [[nodiscard]] Failure paint(const Picture& picture);

    /// All pixels, padding included: four bytes each (in ffmpeg's pixel_format below), rows top to bottom without gaps.
    std::span<const std::byte> bytes() const;
    static const char* pixel_format();

    int width() const;  ///< pixels, padding included
    int height() const; ///< pixels, padding included

  private:
    int picture_width, picture_height;
    CairoSurface surface;
    CairoContext context;
};

} // namespace sinew::canvas

#pragma once

#include "sinew/picture/picture.h"

#include "canvas/cairo_handle.h"

#include <map>

namespace sinew::canvas {

/// Paints the images of a picture. Cairo receives each image once, so that SVG and PDF store each image once.
class ImagePainter {
  public:
    /// Keeps the context and a reference to the picture.
    ImagePainter(cairo_t* context, const Picture& picture) : context_(context), picture_(picture) {}

    /// Paints the image over the grid. An item with a missing image or a grid below 2 x 2 points paints nothing.
    void paint(const Picture::Item& item);

  private:
    cairo_surface_t* surface_of(const Image& image);

    cairo_t* context_;
    const Picture& picture_;
    std::map<const Image*, CairoSurface> surfaces_; ///< created on first use
};

} // namespace sinew::canvas

#pragma once

#include "sinew/picture/picture.h"

#include "canvas/cairo_handle.h"

#include <map>

namespace sinew::canvas {

/// Paints the images of a picture. Each is handed to cairo once, so that SVG and PDF hold it once.
class ImagePainter {
  public:
    /// Both are kept by reference.
    ImagePainter(cairo_t* context, const Picture& picture) : context_(context), picture_(picture) {}

    /// The image over its grid. An item whose image or whose grid is none paints nothing.
    void paint(const Picture::Item& item);

  private:
    cairo_surface_t* surface_of(const Image& image);

    cairo_t* context_;
    const Picture& picture_;
    std::map<const Image*, CairoSurface> surfaces_; ///< made when first needed
};

} // namespace sinew::canvas

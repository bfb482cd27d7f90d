#pragma once

#include "sinew/picture/picture.h"

#include <cairo.h>

namespace sinew::canvas {

/// A rectangle of the surface, in user units (pixels of a raster, px of an SVG, points of a PDF).
struct Region {
    double x = 0, y = 0, width = 0, height = 0;
};

/// Fills the whole clip region with one colour.
void cover(cairo_t* context, const Color& color);

/// Paints a picture at one pixel per user unit, with the picture's origin at the context's origin. Works on any cairo
/// surface: only fills and strokes with the OVER operator are used, so that SVG and PDF keep vectors.
///
/// Degenerate input: a line thinner than a device pixel is painted one pixel wide, an item with a point that is not
/// finite is skipped, coordinates are clamped to cairo's fixed-point range.
void paint(cairo_t* context, const Picture& picture);

/// Writes a line of text centred on `middle`, letters `height` pixels high, on a rim of `paper` that sets the text off
/// from the background.
void write(cairo_t* context, const std::string& text, Vec2<float> middle, double height, const Color& color,
           const Color& paper);
/// Size of such a line in pixels, rim included.
Vec2<double> size_of_text(const std::string& text, double height);

/// Paints a picture into a region: scaled uniformly to fit, centred, the rest filled with the picture's background.
void paint_fitted(cairo_t* context, const Picture& picture, const Region& region);

} // namespace sinew::canvas

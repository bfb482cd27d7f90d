#pragma once

#include "sinew/picture/picture.h"

#include <cairo.h>

namespace sinew::canvas {

/// A rectangle of the surface, in its user units (pixels of a raster, px of an SVG, points of a PDF).
struct Region {
    double x = 0, y = 0, width = 0, height = 0;
};

/// Covers all that the clip lets through with one colour.
void cover(cairo_t* context, const Color& color);

/// Paints a picture, one pixel to one user unit, with its origin at the origin of the context. Works on any cairo
/// surface: only fills and strokes in the OVER operator are used, so that SVG and PDF keep vectors.
///
/// What cannot be seen is still handled: a line thinner than a device pixel is painted one pixel wide, an item with a
/// point that is not finite is left out, a point far away is drawn at the edge of what cairo can count.
void paint(cairo_t* context, const Picture& picture);

/// A line of text about a middle, in letters so many pixels high, on a rim of `paper` that parts it from what is
/// behind.
void write(cairo_t* context, const std::string& text, Vec2<float> middle, double height, const Color& color,
           const Color& paper);
/// How many pixels that takes, rim and all.
Vec2<double> size_of_text(const std::string& text, double height);

/// Paints a picture into a region: scaled evenly until it just fits, centred, the rest filled with its background.
void paint_fitted(cairo_t* context, const Picture& picture, const Region& region);

} // namespace sinew::canvas

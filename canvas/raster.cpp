#include "canvas/raster.h"

#include "canvas/cairo_painter.h"

#include <bit>

namespace sinew::canvas {

Raster::Raster(int width, int height, int padding_right, int padding_bottom)
    : picture_width(width), picture_height(height),
      surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width + padding_right, height + padding_bottom)),
      context(cairo_create(surface.get())) {}

Failure Raster::paint(const Picture& picture) {
    cover(context.get(), {1, 1, 1, 1});
    // The padding takes the background too: an edge in the picture's colour is less visible than a white one.
    if (width() > picture_width || height() > picture_height) cover(context.get(), picture.background);
    paint_fitted(context.get(), picture, {0, 0, double(picture_width), double(picture_height)});
    cairo_surface_flush(surface.get());
    const cairo_status_t status = cairo_status(context.get());
    if (status != CAIRO_STATUS_SUCCESS) return std::string("painting failed: ") + cairo_status_to_string(status);
    return {};
}

std::span<const std::byte> Raster::bytes() const {
    const auto stride = std::size_t(cairo_image_surface_get_stride(surface.get()));
    const auto* first = reinterpret_cast<const std::byte*>(cairo_image_surface_get_data(surface.get()));
    return {first, first == nullptr ? 0 : stride * std::size_t(height())};
}

const char* Raster::pixel_format() {
    return std::endian::native == std::endian::little ? "bgr0" : "0rgb";
}

int Raster::width() const {
    return cairo_image_surface_get_width(surface.get());
}

int Raster::height() const {
    return cairo_image_surface_get_height(surface.get());
}

} // namespace sinew::canvas

#include "canvas/drawing.h"

#include "canvas/formats.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

namespace sinew::canvas {

Failure Drawing::create(const std::filesystem::path& path, int width, int height) {
    abandon();
    sink = {std::fopen(path.c_str(), "wbe"), 0};
    if (sink.file == nullptr) return "the file cannot be opened: " + std::string(std::strerror(errno));
    if (extension_of(path) == ".svg") {
        surface.reset(cairo_svg_surface_create_for_stream(write, &sink, width, height));
        cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
    } else if (extension_of(path) == ".pdf") {
        surface.reset(cairo_pdf_surface_create_for_stream(write, &sink, width, height));
    } else {
        surface.reset(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height));
    }
    pen.reset(cairo_create(surface.get()));
    return {};
}

cairo_status_t Drawing::write(void* where, const unsigned char* data, unsigned int length) {
    auto& [file, error] = *static_cast<Sink*>(where);
    if (std::fwrite(data, 1, length, file) == length) return CAIRO_STATUS_SUCCESS;
    if (error == 0) error = errno;
    return CAIRO_STATUS_WRITE_ERROR;
}

Failure Drawing::finish() {
    cairo_status_t status = cairo_status(pen.get());
    pen.reset();
    if (cairo_surface_get_type(surface.get()) == CAIRO_SURFACE_TYPE_IMAGE && status == CAIRO_STATUS_SUCCESS)
        status = cairo_surface_write_to_png_stream(surface.get(), write, &sink);
    cairo_surface_finish(surface.get());
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface.get());
    close();
    if (sink.error != 0) return std::strerror(sink.error);
    if (status != CAIRO_STATUS_SUCCESS) return cairo_status_to_string(status);
    return {};
}

void Drawing::abandon() {
    pen.reset();
    surface.reset(); // may still write, so before the file is closed
    close();
}

void Drawing::close() {
    if (sink.file == nullptr) return;
    if (std::fclose(std::exchange(sink.file, nullptr)) != 0 && sink.error == 0) sink.error = errno;
}

} // namespace sinew::canvas

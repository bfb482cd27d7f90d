#pragma once

#include <cairo.h>
#include <memory>

namespace sinew::canvas {

struct CairoRelease {
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
    void operator()(cairo_t* context) const { cairo_destroy(context); }
};

/// Owners of cairo objects. Cairo never returns null: a failed creation returns an object with the error in the status.
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoRelease>;
using CairoContext = std::unique_ptr<cairo_t, CairoRelease>;

} // namespace sinew::canvas

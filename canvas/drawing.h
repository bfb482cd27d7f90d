#pragma once

#include "canvas/cairo_handle.h"
#include "canvas/failure.h"

#include <cstdio>
#include <filesystem>

namespace sinew::canvas {

/// A PNG, SVG or PDF file (by extension) drawn with cairo. PNG keeps transparency; SVG and PDF keep vectors.
class Drawing {
  public:
    Drawing() = default;
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;
    ~Drawing() { abandon(); }

    [[nodiscard]] Failure create(const std::filesystem::path& path, int width, int height);
    cairo_t* context() const { return pen.get(); }

    /// Flushes the drawing and closes the file.
    [[nodiscard]] Failure finish();

    /// Closes the file without completing the drawing.
    void abandon();

  private:
    /// Output file of cairo, and the errno of the first failed write (0: none).
    struct Sink {
        std::FILE* file = nullptr;
        int error = 0;
    };

    static cairo_status_t write(void* sink, const unsigned char* data, unsigned int length);
    void close();

    Sink sink;
    CairoSurface surface;
    CairoContext pen;
};

} // namespace sinew::canvas

#include "bindings/c/simulation.h"
#include "bindings/python/core/simulation.h"
#include "canvas/cairo_handle.h"
#include "canvas/cairo_painter.h"
#include "canvas/formats.h"

#include <algorithm>
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <pybind11/stl.h>

/// Pictures and films of a simulation. The C face gives a display list; canvas/ paints it.
namespace sinew::python {
namespace {

struct View {
    std::uint32_t width = 0, height = 0; ///< pixels
    std::uint32_t overlays = 0;          ///< bits as in sinew_world_draw()
};

/// Draws the simulation, whose lock the caller holds. The images have pixels, unlike those of the C face.
Picture draw(Simulation& simulation, const View& view) {
    sinew_picture drawn{};
    check(sinew_world_draw(simulation.handle(), view.width, view.height, view.overlays, &drawn));
    Picture picture = c::simulations().find(simulation.handle().id)->drawn.picture;
    for (std::uint32_t i = 0; i < picture.images.size(); ++i) {
        const char* name = nullptr;
        if (sinew_world_picture_image(simulation.handle(), i, &name) != SINEW_OK) continue;
        const auto& known = simulation.images();
        const auto found =
            std::find_if(known.begin(), known.end(), [&](const auto& image) { return image.first == name; });
        if (found != known.end()) picture.images[i] = found->second;
    }
    return picture;
}

Picture locked_draw(Simulation& simulation, const View& view) {
    const Hold hold(simulation.mutex());
    return draw(simulation, view);
}

/// Paints on a white surface.
void paint(cairo_surface_t* surface, const Picture& picture) {
    const canvas::CairoContext context(cairo_create(surface));
    canvas::cover(context.get(), {1, 1, 1, 1});
    canvas::paint(context.get(), picture);
    cairo_surface_flush(surface);
}

canvas::CairoSurface raster_of(const Picture& picture) {
    const py::gil_scoped_release others;
    canvas::CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.width, picture.height));
    paint(surface.get(), picture);
    return surface;
}

cairo_status_t append(void* text, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

py::bytes png(Simulation& simulation, const View& view) {
    const auto surface = raster_of(locked_draw(simulation, view));
    std::string file;
    if (cairo_surface_write_to_png_stream(surface.get(), append, &file) != CAIRO_STATUS_SUCCESS)
        raise(SINEW_BAD_ARGUMENT, "the picture could not be written");
    return file;
}

py::str svg(Simulation& simulation, const View& view) {
    const auto picture = locked_draw(simulation, view);
    std::string file;
    {
        const canvas::CairoSurface surface(
            cairo_svg_surface_create_for_stream(append, &file, picture.width, picture.height));
        cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PX);
        paint(surface.get(), picture);
    }
    return file;
}

/// Red, green and blue of every pixel: (height, width, 3) bytes.
py::array_t<std::uint8_t> pixels(Simulation& simulation, const View& view) {
    const auto surface = raster_of(locked_draw(simulation, view));
    const auto width = py::ssize_t(view.width), height = py::ssize_t(view.height);
    py::array_t<std::uint8_t> array({height, width, py::ssize_t(3)});
    const auto* const first = cairo_image_surface_get_data(surface.get());
    if (!first) raise(SINEW_BAD_ARGUMENT, "there is no memory for so large a picture");
    auto* out = array.mutable_data();
    for (py::ssize_t y = 0; y < height; ++y) {
        const auto* row =
            reinterpret_cast<const std::uint32_t*>(first + y * cairo_image_surface_get_stride(surface.get()));
        for (py::ssize_t x = 0; x < width; ++x)
            for (const int shift : {16, 8, 0}) *out++ = std::uint8_t(row[x] >> shift);
    }
    return array;
}

/// A file of pictures, by its extension; see canvas::Writer.
class Film {
  public:
    Film(const std::string& path, std::uint32_t width, std::uint32_t height, double fps) {
        const canvas::FrameFormat format{.width = int(width), .height = int(height), .fps = fps};
        if (const auto problem = canvas::check(path, format)) raise(SINEW_BAD_ARGUMENT, *problem);
        auto opened = canvas::open(path, format);
        if (opened.failure) raise(SINEW_BAD_ARGUMENT, *opened.failure);
        writer_ = std::move(opened.writer);
    }
    void add(Simulation& simulation, const View& view) {
        const auto picture = locked_draw(simulation, view);
        run([&] { return writer_->frame(picture); });
    }
    void finish() {
        run([&] { return writer_->finish(); });
    }

  private:
    /// Calls work() without the GIL and raises its failure.
    template <class Work> void run(const Work& work) {
        canvas::Failure failure;
        {
            const py::gil_scoped_release others;
            failure = work();
        }
        if (failure) raise(SINEW_BAD_ARGUMENT, *failure);
    }

    std::unique_ptr<canvas::Writer> writer_;
};

/// Calls paint(simulation, view) with the numbers of a view.
template <class Result> auto with_view(Result (*paint)(Simulation&, const View&)) {
    return [paint](Simulation& self, std::uint32_t width, std::uint32_t height, std::uint32_t overlays) {
        return paint(self, {width, height, overlays});
    };
}

} // namespace

void bind_painting(py::module_& module, py::class_<Simulation, std::shared_ptr<Simulation>>& type) {
    type.def("png", with_view(png)).def("svg", with_view(svg)).def("pixels", with_view(pixels));
    py::class_<Film>(module, "Film")
        .def(py::init<const std::string&, std::uint32_t, std::uint32_t, double>())
        .def("add",
             [](Film& self, Simulation& simulation, std::uint32_t width, std::uint32_t height, std::uint32_t overlays) {
                 self.add(simulation, {width, height, overlays});
             })
        .def("finish", &Film::finish);
}

} // namespace sinew::python

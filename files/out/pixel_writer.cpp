#include "files/out/pixel_writer.h"

#include "canvas/cairo_handle.h"
#include "canvas/cairo_painter.h"
#include "canvas/ffmpeg.h"
#include "canvas/formats.h"

#include <fmt/format.h>
#include <memory>
#include <vector>

namespace sinew::files {
namespace {

using canvas::Failure;
using Arguments = std::vector<std::string>;

Arguments encoding(const std::string& ending) {
    if (ending == ".jpg") return {"-c:v", "mjpeg", "-pix_fmt", "yuvj444p", "-q:v", "2", "-update", "1", "-f", "image2"};
    if (ending == ".apng") return {"-c:v", "apng", "-plays", "0", "-f", "apng"};
    if (ending == ".webm")
        return {"-c:v", "libvpx-vp9", "-pix_fmt", "yuva420p",  "-b:v", "0",  "-crf",
                "20",   "-deadline",  "realtime", "-cpu-used", "6",    "-f", "webm"};
    return {"-c:v", "prores_ks", "-profile:v", "4444", "-pix_fmt", "yuva444p10le", "-f", "mov"};
}

class PixelWriter final : public canvas::Writer {
  public:
    PixelWriter(const std::filesystem::path& path, const canvas::FrameFormat& frame_format)
        : Writer(path, frame_format),
          surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, format.width, format.height)),
          pen_(cairo_create(surface_.get())), pixels_(4 * std::size_t(format.width) * std::size_t(format.height)) {}

  private:
    Failure start() override {
        Arguments all{"-f",          "rawvideo",
                      "-pix_fmt",    "bgra",
                      "-video_size", fmt::format("{}x{}", format.width, format.height),
                      "-framerate",  fmt::format("{}", format.fps),
                      "-i",          "pipe:0"};
        const auto ending = canvas::extension_of(target);
        for (const auto& word : encoding(ending)) all.push_back(word);
        all.push_back("file:" + partial.path().string());
        return ffmpeg_.start(all, ending);
    }

    Failure add(const Picture& picture) override {
        cairo_set_operator(pen_.get(), CAIRO_OPERATOR_CLEAR);
        cairo_paint(pen_.get());
        cairo_set_operator(pen_.get(), CAIRO_OPERATOR_OVER);
        canvas::paint_fitted(pen_.get(), picture, {0, 0, double(format.width), double(format.height)});
        cairo_surface_flush(surface_.get());
        divide_by_alpha();
        return ffmpeg_.send(pixels_);
    }

    /// Cairo's pixels are premultiplied, those of a film are not.
    void divide_by_alpha() {
        const auto* const data = cairo_image_surface_get_data(surface_.get());
        const auto stride = std::size_t(cairo_image_surface_get_stride(surface_.get()));
        const auto row_bytes = 4 * std::size_t(format.width);
        for (std::size_t y = 0; y < std::size_t(format.height); ++y)
            for (std::size_t x = 0; x < row_bytes; x += 4) {
                const auto* const pixel = data + y * stride + x;
                const unsigned alpha = pixel[3];
                auto* const straight = &pixels_[y * row_bytes + x];
                for (int c = 0; c < 3; ++c)
                    straight[c] = std::byte(alpha == 0 ? 0 : std::min(255u, (pixel[c] * 255u + alpha / 2) / alpha));
                straight[3] = std::byte(alpha);
            }
    }

    Failure complete() override { return ffmpeg_.finish(); }
    void abandon() override { ffmpeg_.abandon(); }

    canvas::CairoSurface surface_;
    canvas::CairoContext pen_;
    std::vector<std::byte> pixels_;
    canvas::Ffmpeg ffmpeg_;
};

} // namespace

canvas::Opened open_pixels(const std::filesystem::path& path, const canvas::FrameFormat& format) {
    return canvas::begun(std::make_unique<PixelWriter>(path, format));
}

} // namespace sinew::files

#include "canvas/image.h"

#include "canvas/cairo_painter.h"
#include "canvas/drawing.h"

namespace sinew::canvas {
namespace {

class ImageWriter final : public Writer {
  public:
    using Writer::Writer;

  private:
    Failure start() override { return drawing.create(partial.path(), format.width, format.height); }

    Failure add(const Picture& picture) override {
        if (frames > 0) return "it holds one picture, not several";
        paint_fitted(drawing.context(), picture, {0, 0, double(format.width), double(format.height)});
        return {};
    }

    Failure complete() override { return drawing.finish(); }
    void abandon() override { drawing.abandon(); }

    Drawing drawing;
};

} // namespace

Opened open_image(const std::filesystem::path& target, const FrameFormat& format) {
    return begun(std::make_unique<ImageWriter>(target, format));
}

} // namespace sinew::canvas

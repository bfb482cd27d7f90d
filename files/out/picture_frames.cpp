#include "canvas/formats.h"
#include "canvas/image.h"
#include "files/out/export_formats.h"
#include "files/out/frame_name.h"
#include "files/out/frame_picture.h"
#include "files/out/pixel_writer.h"

/// A picture a frame: PNG, with transparency where the background has it, SVG, and JPEG.
namespace sinew::files {
namespace {

class PictureExporter final : public Exporter {
  public:
    explicit PictureExporter(const ExportRequest& request) : request_(request) {}

    Failure frame(const Session& session) override {
        const auto path = frame_path(request_.path, ++count_);
        draw_frame(session, request_, picture_);
        const canvas::FrameFormat format{.width = picture_.width, .height = picture_.height};
        const auto ending = canvas::extension_of(path);
        const bool is_jpeg = ending == ".jpg";
        if (is_jpeg && picture_.background.alpha < 1) return "a " + ending + " has no transparency; a .png has";
        auto opened = is_jpeg ? open_pixels(path, format) : canvas::open_image(path, format);
        if (opened.failure) return opened.failure;
        if (auto failure = opened.writer->frame(picture_)) return failure;
        if (auto failure = opened.writer->finish()) return failure;
        written_.push_back(path);
        return {};
    }

    Failure finish() override { return {}; }

  private:
    const ExportRequest request_;
    Picture picture_;
    std::size_t count_ = 0;
};

} // namespace

std::unique_ptr<Exporter> open_pictures(const ExportRequest& request) {
    return std::make_unique<PictureExporter>(request);
}

} // namespace sinew::files

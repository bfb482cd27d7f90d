#include "canvas/formats.h"
#include "canvas/image.h"
#include "files/out/export_formats.h"
#include "files/out/frame_name.h"
#include "files/out/frame_picture.h"

/// A picture a frame: PNG, with transparency where the background has it, and SVG.
namespace sinew::files {
namespace {

class PictureExporter final : public Exporter {
  public:
    explicit PictureExporter(const ExportRequest& request) : request_(request) {}

    Failure frame(const Session& session) override {
        const auto path = frame_path(request_.path, ++count_);
        draw_frame(session, request_, picture_);
        auto opened = canvas::open_image(path, {.width = picture_.width, .height = picture_.height});
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

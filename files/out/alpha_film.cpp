#include "files/out/export_formats.h"
#include "files/out/frame_picture.h"
#include "files/out/pixel_writer.h"

#include <memory>

/// Films whose pixels are transparent where the background is: APNG, WebM (VP9) and QuickTime (ProRes 4444), by ffmpeg.
namespace sinew::files {
namespace {

class AlphaExporter final : public Exporter {
  public:
    explicit AlphaExporter(const ExportRequest& request) : request_(request) {}

    Failure frame(const Session& session) override {
        if (!writer_) {
            const canvas::FrameFormat format{request_.size[0], request_.size[1], request_.fps};
            auto opened = open_pixels(request_.path, format);
            if (opened.failure) return opened.failure;
            writer_ = std::move(opened.writer);
        }
        draw_frame(session, request_, picture_);
        return writer_->frame(picture_);
    }

    Failure finish() override {
        written_ = {request_.path};
        return writer_->finish();
    }

  private:
    const ExportRequest request_;
    Picture picture_;
    std::unique_ptr<canvas::Writer> writer_;
};

} // namespace

std::unique_ptr<Exporter> open_alpha_film(const ExportRequest& request) {
    return std::make_unique<AlphaExporter>(request);
}

} // namespace sinew::files

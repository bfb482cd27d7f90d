#include "files/out/vector_film.h"

#include "sinew/math/format.h"

#include "files/out/frame_picture.h"

namespace sinew::files {
namespace {

constexpr double usual_tolerance = 0.25;                  // pixels: invisible at this size
constexpr std::size_t max_numbers = std::size_t(1) << 27; // half a gibibyte

class VectorExporter final : public Exporter {
  public:
    VectorExporter(const ExportRequest& request, std::string (*write)(const VectorFilm&))
        : request_(request), write_(write) {}

    Failure frame(const Session& session) override {
        draw_frame(session, request_, picture_);
        recorder_.add(picture_);
        steps_ = session.scene().dimension == 3;
        if (recorder_.numbers() > max_numbers)
            return format_text("{} frames of {} shapes are too many for moving vectors", recorder_.frames(),
                               picture_.items.size());
        return {};
    }

    Failure finish() override {
        const double tolerance = request_.tolerance.value_or(usual_tolerance);
        const auto text = write_({recorder_, picture_.background, request_.size, request_.fps, tolerance, steps_});
        if (recorder_.has_images()) notes_.emplace_back("images are drawn as their outlines in their mean colour");
        notes_.push_back(steps_ ? "3D: a picture a frame, without interpolation"
                                : format_text("points are at most {:6} px off between keys", tolerance));
        written_ = {request_.path};
        return request_.take(request_.path, text);
    }

  private:
    const ExportRequest request_;
    std::string (*const write_)(const VectorFilm&);
    TrackRecorder recorder_;
    Picture picture_;
    bool steps_ = false;
};

} // namespace

std::unique_ptr<Exporter> open_vectors(const ExportRequest& request, std::string (*write)(const VectorFilm&)) {
    return std::make_unique<VectorExporter>(request, write);
}

} // namespace sinew::files

#include "sinew/math/format.h"

#include "files/out/export_formats.h"
#include "files/out/glb_scene.h"
#include "files/out/mesh_film.h"

namespace sinew::files {
namespace {

constexpr double usual_error = 0.01; // millimetres: each frame is what was simulated

class GlbExporter final : public Exporter {
  public:
    explicit GlbExporter(const ExportRequest& request) : request_(request) {}

    Failure frame(const Session& session) override {
        if (auto failure = film_.add(session, {.figures = request_.figures, .balls = true, .images = true}, ".glb"))
            return failure;
        if (film_.form().elements.empty()) return "the scene shows no figure: a .glb would be empty";
        return {};
    }

    Failure finish() override {
        const double tolerance = request_.tolerance.value_or(usual_error) / 1000;
        std::string bytes;
        if (auto failure = glb_of(film_, {request_.fps, tolerance, request_.joints}, bytes, notes_)) return failure;
        for (const auto& figure : film_.form().bare)
            notes_.push_back(format_text("{}: images that face the viewer are not taken", figure));
        notes_.push_back(format_text("points are at most {:6} mm off between keys", tolerance * 1000));
        written_ = {request_.path};
        return request_.take(request_.path, bytes);
    }

  private:
    const ExportRequest request_;
    MeshFilm film_;
};

} // namespace

std::unique_ptr<Exporter> open_glb(const ExportRequest& request) {
    return std::make_unique<GlbExporter>(request);
}

} // namespace sinew::files

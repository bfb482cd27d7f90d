#include "files/out/export_formats.h"
#include "files/out/glb_scene.h"
#include "files/out/mesh_film.h"
#include "files/out/output_file.h"

namespace sinew::files {
namespace {

class GlbExporter final : public Exporter {
  public:
    explicit GlbExporter(const ExportRequest& request) : request_(request) {}

    Failure frame(const Session& session) override {
        if (auto failure = film_.add(session, {.figures = request_.figures, .balls = true}, ".glb")) return failure;
        if (film_.form().elements.empty()) return "the scene shows no figure: a .glb would be empty";
        return {};
    }

    Failure finish() override {
        std::string bytes;
        if (auto failure = glb_of(film_, request_.fps, bytes, notes_)) return failure;
        written_ = {request_.path};
        return write_file(request_.path, bytes);
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

#include "files/out/export_formats.h"
#include "files/out/frame_name.h"
#include "files/out/obj_text.h"

namespace sinew::files {
namespace {

/// Path of the materials that all frames share: "cloth-%04d.obj" has cloth.mtl.
std::filesystem::path material_path(const std::filesystem::path& pattern) {
    auto stem = pattern.stem().string();
    if (has_frame_number(pattern)) stem = stem.substr(0, stem.find('%'));
    while (!stem.empty() && (stem.back() == '-' || stem.back() == '_' || stem.back() == '.')) stem.pop_back();
    return pattern.parent_path() / ((stem.empty() ? "frames" : stem) + ".mtl");
}

class ObjExporter final : public Exporter {
  public:
    explicit ObjExporter(const ExportRequest& request) : request_(request) {}

    Failure frame(const Session& session) override {
        const auto mesh = mesh_of(session, {.figures = request_.figures});
        if (mesh.elements.empty() && count_ == 0)
            return "the scene shows neither faces nor lines: an .obj would be empty";
        if (mesh.groups.size() > groups_.size()) groups_ = mesh.groups;
        const auto path = frame_path(request_.path, ++count_);
        const auto text = obj_text(mesh, material_path(request_.path).filename().string());
        if (auto failure = request_.take(path, text)) return failure;
        written_.push_back(path);
        return {};
    }

    Failure finish() override {
        const auto path = material_path(request_.path);
        if (auto failure = request_.take(path, mtl_text(groups_))) return failure;
        written_.push_back(path);
        return {};
    }

  private:
    const ExportRequest request_;
    std::vector<MeshGroup> groups_;
    std::size_t count_ = 0;
};

} // namespace

std::unique_ptr<Exporter> open_obj(const ExportRequest& request) {
    return std::make_unique<ObjExporter>(request);
}

} // namespace sinew::files

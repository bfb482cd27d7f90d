#include "files/out/export_formats.h"
#include "files/out/frame_name.h"
#include "files/out/output_file.h"
#include "files/out/scene_mesh.h"

#include <fmt/format.h>

namespace sinew::files {
namespace {

/// Colour of each vertex: of its first element.
std::vector<Color> vertex_colors(const SceneMesh& mesh) {
    std::vector<Color> colors(mesh.vertices.size(), Color{});
    std::vector<bool> known(mesh.vertices.size());
    for (const auto& element : mesh.elements)
        for (const auto corner : mesh.corners_of(element))
            if (!known[corner]) colors[corner] = mesh.group_of(element).color, known[corner] = true;
    return colors;
}

std::byte byte_of(float share) {
    return std::byte(int(share * 255 + 0.5F));
}

/// Binary PLY 1.0, lowest byte first (Turk 1994): vertices with colours, faces, edges.
class PlyText {
  public:
    explicit PlyText(const SceneMesh& mesh) : mesh_(mesh) {
        for (const auto& element : mesh.elements) {
            if (element.kind == ElementKind::face) ++faces_;
            if (element.kind == ElementKind::line || element.kind == ElementKind::ring) edges_ += element.count - 1;
        }
    }

    void write(OutputFile& file) const {
        file.put(header());
        const auto colors = vertex_colors(mesh_);
        for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) file.put_little(float(mesh_.vertices[i][axis]));
            const auto& c = colors[i];
            const std::array bytes = {byte_of(c.red), byte_of(c.green), byte_of(c.blue), byte_of(c.alpha)};
            file.put_bytes(bytes);
        }
        for (const auto& element : mesh_.elements)
            if (element.kind == ElementKind::face) write_face(element, file);
        for (const auto& element : mesh_.elements)
            if (element.kind == ElementKind::line || element.kind == ElementKind::ring) write_edges(element, file);
    }

  private:
    std::string header() const {
        std::string text = "ply\nformat binary_little_endian 1.0\ncomment Sinew: metres, y upwards\n";
        text += fmt::format("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
                            mesh_.vertices.size());
        for (const auto* name : {"red", "green", "blue", "alpha"}) text += fmt::format("property uchar {}\n", name);
        text += fmt::format("element face {}\nproperty list uint uint vertex_indices\n", faces_);
        return text +
               fmt::format("element edge {}\nproperty uint vertex1\nproperty uint vertex2\nend_header\n", edges_);
    }

    void write_face(const MeshElement& face, OutputFile& file) const {
        file.put_little(face.count);
        for (const auto corner : mesh_.corners_of(face)) file.put_little(corner);
    }
    void write_edges(const MeshElement& line, OutputFile& file) const {
        const auto corners = mesh_.corners_of(line);
        for (std::size_t i = 0; i + 1 < corners.size(); ++i)
            file.put_little(corners[i]), file.put_little(corners[i + 1]);
    }

    const SceneMesh& mesh_;
    std::size_t faces_ = 0, edges_ = 0;
};

class PlyExporter final : public Exporter {
  public:
    explicit PlyExporter(const ExportRequest& request) : request_(request) {}

    Failure frame(const Session& session) override {
        const auto mesh = mesh_of(session, {.figures = request_.figures, .balls = true});
        OutputFile file;
        if (auto failure = file.create(frame_path(request_.path, ++count_))) return failure;
        PlyText(mesh).write(file);
        if (auto failure = file.commit()) return failure;
        written_.push_back(file.path());
        return {};
    }

    Failure finish() override { return {}; }

  private:
    const ExportRequest request_;
    std::size_t count_ = 0;
};

} // namespace

std::unique_ptr<Exporter> open_ply(const ExportRequest& request) {
    return std::make_unique<PlyExporter>(request);
}

} // namespace sinew::files

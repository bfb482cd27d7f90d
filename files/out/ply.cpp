#include "sinew/math/format.h"

#include "files/out/bytes.h"
#include "files/out/export_formats.h"
#include "files/out/frame_name.h"
#include "files/out/scene_mesh.h"

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

char byte_of(float share) {
    return char(int(share * 255 + 0.5F));
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

    std::string text() const {
        auto file = header();
        const auto colors = vertex_colors(mesh_);
        for (std::size_t i = 0; i < mesh_.vertices.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) put_little(file, float(mesh_.vertices[i][axis]));
            const auto& c = colors[i];
            for (const float channel : {c.red, c.green, c.blue, c.alpha}) file += byte_of(channel);
        }
        for (const auto& element : mesh_.elements)
            if (element.kind == ElementKind::face) write_face(element, file);
        for (const auto& element : mesh_.elements)
            if (element.kind == ElementKind::line || element.kind == ElementKind::ring) write_edges(element, file);
        return file;
    }

  private:
    std::string header() const {
        std::string text = "ply\nformat binary_little_endian 1.0\ncomment Sinew: metres, y upwards\n";
        text += format_text("element vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
                            mesh_.vertices.size());
        for (const auto* name : {"red", "green", "blue", "alpha"}) text += format_text("property uchar {}\n", name);
        text += format_text("element face {}\nproperty list uint uint vertex_indices\n", faces_);
        return text +
               format_text("element edge {}\nproperty uint vertex1\nproperty uint vertex2\nend_header\n", edges_);
    }

    void write_face(const MeshElement& face, std::string& file) const {
        put_little(file, face.count);
        for (const auto corner : mesh_.corners_of(face)) put_little(file, corner);
    }
    void write_edges(const MeshElement& line, std::string& file) const {
        const auto corners = mesh_.corners_of(line);
        for (std::size_t i = 0; i + 1 < corners.size(); ++i)
            put_little(file, corners[i]), put_little(file, corners[i + 1]);
    }

    const SceneMesh& mesh_;
    std::size_t faces_ = 0, edges_ = 0;
};

class PlyExporter final : public Exporter {
  public:
    explicit PlyExporter(const ExportRequest& request) : request_(request) {}

    Failure frame(const Session& session) override {
        const auto mesh = mesh_of(session, {.figures = request_.figures, .balls = true});
        const auto path = frame_path(request_.path, ++count_);
        if (auto failure = request_.take(path, PlyText(mesh).text())) return failure;
        written_.push_back(path);
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

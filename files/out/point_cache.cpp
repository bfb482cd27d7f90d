#include "sinew/scene/text.h"

#include "files/out/bytes.h"
#include "files/out/export_formats.h"
#include "files/out/mesh_film.h"
#include "files/out/obj_text.h"

/// Caches of moving vertices, for the mesh in the .obj beside them.
namespace sinew::files {
namespace {

/// PC2: numbers with the lowest byte first; samples one frame apart, from frame 1 on.
void write_pc2(const MeshFilm& film, double, std::string& bytes) {
    bytes.append("POINTCACHE2\0", 12);
    put_little(bytes, 1u); // version
    put_little(bytes, std::uint32_t(film.vertices()));
    put_little(bytes, 1.0F); // first frame
    put_little(bytes, 1.0F); // frames from sample to sample
    put_little(bytes, std::uint32_t(film.frames()));
    for (std::size_t frame = 0; frame < film.frames(); ++frame)
        for (const float number : film.numbers(frame)) put_little(bytes, number);
}

/// MDD: numbers with the highest byte first; the second of each sample.
void write_mdd(const MeshFilm& film, double fps, std::string& bytes) {
    put_big(bytes, std::uint32_t(film.frames()));
    put_big(bytes, std::uint32_t(film.vertices()));
    for (std::size_t frame = 0; frame < film.frames(); ++frame) put_big(bytes, float(double(frame) / fps));
    for (std::size_t frame = 0; frame < film.frames(); ++frame)
        for (const float number : film.numbers(frame)) put_big(bytes, number);
}

using WriteCache = void (*)(const MeshFilm&, double fps, std::string& bytes);

class CacheExporter final : public Exporter {
  public:
    CacheExporter(const ExportRequest& request, const char* ending, WriteCache write)
        : request_(request), ending_(ending), write_(write) {}

    Failure frame(const Session& session) override {
        if (auto failure = film_.add(session, {.figures = request_.figures}, ending_)) return failure;
        if (film_.form().elements.empty())
            return concat("the scene shows neither faces nor lines: a ", ending_, " would be empty");
        return {};
    }

    Failure finish() override {
        auto mesh = request_.path, materials = request_.path;
        mesh.replace_extension(".obj"), materials.replace_extension(".mtl");
        if (auto failure = request_.take(materials, mtl_text(film_.form().groups))) return failure;
        if (auto failure = request_.take(mesh, obj_text(film_.form(), materials.filename().string()))) return failure;
        std::string cache;
        write_(film_, request_.fps, cache);
        if (auto failure = request_.take(request_.path, cache)) return failure;
        written_ = {request_.path, mesh, materials};
        return {};
    }

  private:
    const ExportRequest request_;
    const char* const ending_;
    const WriteCache write_;
    MeshFilm film_;
};

} // namespace

std::unique_ptr<Exporter> open_pc2(const ExportRequest& request) {
    return std::make_unique<CacheExporter>(request, ".pc2", write_pc2);
}

std::unique_ptr<Exporter> open_mdd(const ExportRequest& request) {
    return std::make_unique<CacheExporter>(request, ".mdd", write_mdd);
}

} // namespace sinew::files

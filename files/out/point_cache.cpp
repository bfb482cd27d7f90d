#include "canvas/formats.h"
#include "files/out/export_formats.h"
#include "files/out/mesh_film.h"
#include "files/out/obj_text.h"
#include "files/out/output_file.h"

#include <fmt/format.h>

/// Caches of moving vertices, for the mesh in the .obj beside them.
namespace sinew::files {
namespace {

/// PC2: numbers with the lowest byte first; samples one frame apart, from frame 1 on.
void write_pc2(const MeshFilm& film, double, OutputFile& file) {
    file.put(std::string_view("POINTCACHE2\0", 12));
    file.put_little(1u); // version
    file.put_little(std::uint32_t(film.vertices()));
    file.put_little(1.0F); // first frame
    file.put_little(1.0F); // frames from sample to sample
    file.put_little(std::uint32_t(film.frames()));
    for (std::size_t frame = 0; frame < film.frames(); ++frame)
        for (const float number : film.numbers(frame)) file.put_little(number);
}

/// MDD: numbers with the highest byte first; the second of each sample.
void write_mdd(const MeshFilm& film, double fps, OutputFile& file) {
    file.put_big(std::uint32_t(film.frames()));
    file.put_big(std::uint32_t(film.vertices()));
    for (std::size_t frame = 0; frame < film.frames(); ++frame) file.put_big(float(double(frame) / fps));
    for (std::size_t frame = 0; frame < film.frames(); ++frame)
        for (const float number : film.numbers(frame)) file.put_big(number);
}

using WriteCache = void (*)(const MeshFilm&, double fps, OutputFile&);

class CacheExporter final : public Exporter {
  public:
    CacheExporter(const ExportRequest& request, WriteCache write) : request_(request), write_(write) {}

    Failure frame(const Session& session) override {
        const auto ending = canvas::extension_of(request_.path);
        if (auto failure = film_.add(session, {.figures = request_.figures}, ending)) return failure;
        if (film_.form().elements.empty())
            return fmt::format("the scene shows neither faces nor lines: a {} would be empty", ending);
        return {};
    }

    Failure finish() override {
        auto mesh = request_.path, materials = request_.path;
        mesh.replace_extension(".obj"), materials.replace_extension(".mtl");
        if (auto failure = write_file(materials, mtl_text(film_.form().groups))) return failure;
        if (auto failure = write_file(mesh, obj_text(film_.form(), materials.filename().string()))) return failure;
        OutputFile cache;
        if (auto failure = cache.create(request_.path)) return failure;
        write_(film_, request_.fps, cache);
        if (auto failure = cache.commit()) return failure;
        written_ = {request_.path, mesh, materials};
        return {};
    }

  private:
    const ExportRequest request_;
    const WriteCache write_;
    MeshFilm film_;
};

} // namespace

std::unique_ptr<Exporter> open_pc2(const ExportRequest& request) {
    return std::make_unique<CacheExporter>(request, write_pc2);
}

std::unique_ptr<Exporter> open_mdd(const ExportRequest& request) {
    return std::make_unique<CacheExporter>(request, write_mdd);
}

} // namespace sinew::files

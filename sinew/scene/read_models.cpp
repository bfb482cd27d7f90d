#include "sinew/scene/read_models.h"

#include "sinew/scene/file_name.h"
#include "sinew/scene/text.h"

#include <map>

namespace sinew {

ReadModel read_model(std::string_view text, std::string_view name, const Limits& limits) {
    constexpr std::size_t corners_a_point = 8; // 6 in a triangle mesh, 4 in quads, and some room
    const auto points = std::size_t(limits.particles);
    auto read = read_obj(text, {.points = points, .corners = corners_a_point * points + corners_a_point});
    if (const auto* problem = std::get_if<ObjProblem>(&read)) {
        const auto line = problem->line > 0 ? concat(":", problem->line) : "";
        return {nullptr, concat(printable(name), line, ": ", problem->message), ""};
    }
    return {std::make_shared<const MeshModel>(std::get<MeshModel>(std::move(read))), "", ""};
}

void read_models(Scene& scene, const ModelReader& reader, Document& document) {
    std::map<std::string, ReadModel> known;
    for (std::size_t i = 0; i < scene.figures.size(); ++i) {
        auto* mesh = std::get_if<Mesh>(&scene.figures[i].made);
        if (!mesh || mesh->file.empty()) continue;
        const auto place = concat("/figures/", i, "/file");
        if (!in_its_folder(mesh->file, place, "models/sail.obj", document)) continue;
        const auto [found, fresh] = known.try_emplace(mesh->file);
        if (fresh) found->second = reader(mesh->file, document.limits);
        const auto& [model, problem, help] = found->second;
        if (model)
            mesh->model = model;
        else
            document.error(place, problem, help);
    }
}

} // namespace sinew

#include "sinew/scene/read_models.h"

#include "sinew/scene/file_name.h"
#include "sinew/scene/text.h"
#include "sinew/scene/types.h"

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
    return {std::make_shared<const MeshModel>(weld(std::get<MeshModel>(read))), "", ""};
}

namespace {

/// Models by file, each read once.
class Models {
  public:
    Models(const ModelReader& reader, Document& document) : reader_(reader), document_(document) {}

    /// Model of the file that is named at a place; nothing after an error.
    std::shared_ptr<const MeshModel> read(const std::string& file, const std::string& place) {
        if (!in_its_folder(file, place, "models/sail.obj", document_)) return nullptr;
        const auto [found, fresh] = known_.try_emplace(file);
        if (fresh) found->second = reader_(file, document_.limits);
        const auto& [model, problem, help] = found->second;
        if (!model) document_.error(place, problem, help);
        return model;
    }

  private:
    const ModelReader& reader_;
    Document& document_;
    std::map<std::string, ReadModel> known_;
};

} // namespace

void read_models(Scene& scene, const ModelReader& reader, Document& document) {
    Models models(reader, document);
    for (std::size_t i = 0; i < scene.figures.size(); ++i)
        detail::visit_held(scene.figures[i].made, [&](auto& made) {
            if constexpr (requires { made.model; })
                if (!made.file.empty())
                    if (auto model = models.read(made.file, concat("/figures/", i, "/file")))
                        made.model = std::move(model);
        });
    for (std::size_t i = 0; i < scene.colliders.size(); ++i)
        if (auto* mesh = std::get_if<MeshShape>(&scene.colliders[i].shape); mesh && !mesh->file.empty())
            if (auto model = models.read(mesh->file, concat("/colliders/", i, "/file"))) mesh->model = std::move(model);
}

} // namespace sinew

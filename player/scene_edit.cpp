#include "player/scene_edit.h"

#include "sinew/scene/check.h"
#include "sinew/scene/text.h"
#include "sinew/scene/types.h"

#include <algorithm>
#include <functional>
#include <set>

namespace sinew::play {
namespace {

constexpr std::string_view source = "the scene";

/// Opens a changed document, with the models already loaded for the scene.
Edited read_again(Document document, const Scene& scene) {
    const auto model = [&](const std::string& name, const Limits&) -> ReadModel {
        std::shared_ptr<const MeshModel> known;
        for (const auto& figure : scene.figures)
            detail::visit_held(figure.made, [&](const auto& made) {
                if constexpr (requires { made.model; })
                    if (made.file == name) known = made.model;
            });
        if (known) return {known, "", ""};
        return {nullptr, "no mesh of the scene is of " + in_quotes(name), "open the scene again to read another file"};
    };
    if (auto opened = open_scene(document, {}, model)) return {std::move(opened->scene), "", {}};
    auto problem = to_text(document.diagnostics, {.color = false, .max = 5});
    return {std::nullopt, std::move(problem), std::move(document.diagnostics)};
}

std::string constraint_name(const Figure& figure, std::size_t number) {
    for (const auto& [name, id] : figure.constraint_names)
        if (id == figure.constraints[number]) return figure.name + "/" + std::string(name);
    const auto name = name_of(number, figure.constraint_numbers);
    return name.empty() ? "" : figure.name + "/" + name;
}

/// Calls visit(world, figure, is_of_scene) for every figure; those of calls and events are not of the scene.
template <class Visit> void each_figure(const Session& session, Visit&& visit) {
    std::set<std::string, std::less<>> described;
    for (const auto& section : session.scene().figures) described.emplace(name_of(section));
    std::visit(
        [&](const auto& world) {
            for (FigureIndex i = 0; i < world.figures.size(); ++i) {
                const auto& figure = world.figures[i];
                if (figure.in_use())
                    visit(world, figure, described.contains(figure.name) && !session.added().find(figure_id(world, i)));
            }
        },
        session.world());
}

/// Names of the scene's cut constraints: built with the figures, gone from the world. Unnamed constraints are left out.
RemoveEvent removed_constraints(const Session& session) {
    RemoveEvent removal;
    each_figure(session, [&](const auto& world, const Figure& figure, bool is_of_scene) {
        for (std::size_t i = 0; is_of_scene && i < figure.constraints.size(); ++i)
            if (!constraint_state(world, figure.constraints[i]))
                if (auto name = constraint_name(figure, i); !name.empty()) removal.names.push_back(std::move(name));
    });
    return removal;
}

} // namespace

std::string text_of(const Session& session) {
    auto scene = session.scene();
    if (auto removal = removed_constraints(session); !removal.names.empty())
        scene.events.insert(scene.events.begin(), EventSection{.at = 0.0, .on = {}, .event = std::move(removal)});
    return json::to_text(to_json(scene)) + "\n";
}

std::size_t figures_beside_scene(const Session& session) {
    std::size_t count = 0;
    each_figure(session, [&](const auto&, const Figure&, bool is_of_scene) { count += is_of_scene ? 0 : 1; });
    return count;
}

Edited edited(const Scene& scene, const std::function<void(json::Object& root)>& change) {
    auto root = to_json(scene);
    change(*root.as<json::Object>());
    return read_again(load(json::to_text(root), std::string(source)), scene);
}

Edited edited(const Scene& scene, std::span<const Override> overrides) {
    return read_again(load(json::to_text(to_json(scene)), std::string(source), overrides), scene);
}

std::string free_name(const Scene& scene, const std::string& stem) {
    const auto taken = [&](std::string_view name) {
        return std::any_of(scene.figures.begin(), scene.figures.end(),
                           [&](const FigureSection& figure) { return sinew::name_of(figure) == name; });
    };
    auto name = stem;
    for (int number = 2; taken(name); ++number) name = concat(stem, "_", number);
    return name;
}

void append(json::Object& root, std::string_view list, json::Value element) {
    auto* member = json::find(root, list);
    if (!member || !member->value.as<json::Array>()) {
        root.push_back({std::string(list), json::Array{}});
        member = &root.back();
    }
    member->value.as<json::Array>()->push_back(std::move(element));
}

} // namespace sinew::play

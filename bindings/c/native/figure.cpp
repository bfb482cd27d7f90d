#include "sinew/scene/check.h"
#include "sinew/scene/text.h"
#include "sinew/world/edit.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <cmath>

/// Figures added, changed and removed by calls.
using namespace sinew;
using namespace sinew::c;

namespace {

/// Parameters as overrides of the only figure of a scene; nothing where a name is missing.
std::optional<std::vector<Override>> overrides_of(const sinew_parameter* parameters, std::uint32_t count) {
    std::vector<Override> overrides;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto& parameter = parameters[i];
        if (!parameter.name) return std::nullopt;
        const auto value = parameter.word ? std::string(parameter.word) : json::to_text(parameter.number);
        overrides.push_back({concat("figures.0.", parameter.name, "=", value), "a parameter"});
    }
    return overrides;
}

std::string free_name(const AnyWorld& world, const std::string& stem) {
    const auto taken = [&](const std::string& name) {
        return std::visit([&](const auto& any) { return find_figure(any, name).has_value(); }, world);
    };
    auto name = stem;
    for (int number = 2; taken(name); ++number) name = concat(stem, "_", number);
    return name;
}

/// Opens a figure, as JSON, in a scene of the units and the mode of another. Diagnostics are kept.
std::optional<Opened> opened_alone(const Scene& scene, const std::string& figure,
                                   const std::vector<Override>& overrides) {
    const json::Object units{{"length", scene.units.length}, {"time", scene.units.time}, {"up", scene.units.up}};
    const json::Object solver{{"mode", scene.solver.mode}, {"precision", scene.solver.precision}};
    const auto text = concat("{\"sinew\": 1, \"dimension\": ", scene.dimension, ", \"units\": ", json::to_text(units),
                             ", \"solver\": ", json::to_text(solver), ", \"figures\": [", figure, "]}");
    auto document = load(text, "sinew_figure_spec", overrides);
    auto opened = open_scene(document);
    return keep_diagnostics(document.diagnostics) == SINEW_OK ? std::move(opened) : std::nullopt;
}

std::optional<FigureIndex> figure_called(const Session& session, std::string_view name) {
    return std::visit([&](const auto& world) { return find_figure(world, name); }, session.world());
}

sinew_status add_figure(Session& session, const sinew_figure_spec& spec, std::uint32_t* figure) {
    const auto overrides = overrides_of(spec.parameters, spec.parameter_count);
    if (!overrides) return null_argument();
    const auto& scene = session.scene();
    const json::Object described{{"prefab", spec.prefab},
                                 {"name", spec.name ? std::string(spec.name) : free_name(session.world(), spec.prefab)},
                                 {"at", numbers_of(spec.position, scene.dimension)},
                                 {"velocity", numbers_of(spec.velocity, scene.dimension)}};
    auto opened = opened_alone(scene, json::to_text(described), *overrides);
    if (!opened) return SINEW_BAD_SCENE;
    auto& section = opened->scene.figures.front();
    if (spec.turn != 0) section.turn = spec.turn; // a parameter, too, may say it
    const std::string name(name_of(section));     // as of the name
    if (figure_called(session, name))
        return fail(SINEW_BAD_ARGUMENT, concat("a figure is called ", in_quotes(name), " already"));
    const auto added = session.add(section);
    if (figure) *figure = added;
    return SINEW_OK;
}

sinew_status set_figure(Session& session, FigureIndex figure, const std::vector<Override>& overrides) {
    const auto id =
        std::visit([&](const auto& world) { return has_figure(world, figure) ? figure_id(world, figure) : FigureId{}; },
                   session.world());
    if (id == FigureId{}) return bad_id("figure");
    const auto* described = session.added().find(id);
    if (!described) return fail(SINEW_BAD_ARGUMENT, "a figure of the scene: sinew_world_set() changes it");
    const auto before = opened_alone(session.scene(), *described, {});
    const auto after = before ? opened_alone(session.scene(), *described, overrides) : std::nullopt;
    if (!after) return SINEW_BAD_SCENE;
    if (name_of(after->scene.figures.front()) != name_of(before->scene.figures.front()))
        return fail(SINEW_BAD_ARGUMENT, "a figure keeps its name");
    const auto why_not = session.change(figure, *before, *after);
    return why_not.empty() ? SINEW_OK : fail(SINEW_BAD_ARGUMENT, why_not);
}

} // namespace

extern "C" {

sinew_status sinew_world_add_figure(sinew_world simulation, const sinew_figure_spec* given, uint32_t* figure) {
    sinew_figure_spec spec;
    if (const auto status = take(given, spec)) return status;
    if (!spec.prefab || (spec.parameter_count > 0 && !spec.parameters)) return null_argument();
    if (!is_finite(spec.position) || !is_finite(spec.velocity) || !std::isfinite(spec.turn)) return not_finite();
    return change(simulation, [&](Session& session) { return ::add_figure(session, spec, figure); });
}

sinew_status sinew_world_set_figure(sinew_world simulation, uint32_t figure, const sinew_parameter* parameters,
                                    uint32_t count) {
    if (count > 0 && !parameters) return null_argument();
    const auto overrides = overrides_of(parameters, count);
    if (!overrides) return null_argument();
    return change(simulation, [&](Session& session) { return ::set_figure(session, FigureIndex(figure), *overrides); });
}

sinew_status sinew_world_remove_figure(sinew_world simulation, uint32_t figure) {
    return change(simulation, [&](Session& session) {
        const bool was =
            std::visit([&](auto& world) { return remove_figure(world, FigureIndex(figure)); }, session.world());
        return was ? SINEW_OK : bad_id("figure");
    });
}

sinew_status sinew_world_find_figure(sinew_world simulation, const char* name, uint32_t* figure) {
    if (!name || !figure) return null_argument();
    return read(simulation, [&](const Simulation&, const Session& session) {
        const auto found = figure_called(session, name);
        if (!found) return fail(SINEW_NOT_FOUND, concat("no figure is called ", in_quotes(name)));
        *figure = *found;
        return SINEW_OK;
    });
}

} // extern "C"

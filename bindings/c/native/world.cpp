#include "sinew/scene/check.h"
#include "sinew/scene/text.h"
#include "sinew/world/environment.h"

#include "bindings/c/native/sized.h"
#include "bindings/c/simulation.h"

#include <cmath>

/// Worlds built by calls: an empty one, and figures in it.
using namespace sinew;
using namespace sinew::c;

static_assert(kind_number<Distance, 2> == SINEW_DISTANCE && kind_number<Distance, 3> == SINEW_DISTANCE &&
              kind_number<Angle, 2> == SINEW_ANGLE && kind_number<Angle, 3> == SINEW_ANGLE &&
              kind_number<Area, 2> == SINEW_AREA_2D && kind_number<Pulley, 2> == SINEW_PULLEY_2D &&
              kind_number<Rail, 2> == SINEW_RAIL_2D && kind_number<Volume, 3> == SINEW_VOLUME_3D &&
              kind_number<Dihedral, 3> == SINEW_DIHEDRAL_3D && kind_number<Pulley, 3> == SINEW_PULLEY_3D);

namespace {

json::Array list_of(const sinew_point& point, int dimension) {
    json::Array list{point.x, point.y};
    if (dimension == 3) list.emplace_back(point.z);
    return list;
}

/// Scene without figures, as text.
std::string scene_of(const sinew_world_spec& spec, int dimension) {
    json::Object world{{"gravity", list_of(spec.gravity, dimension)}, {"damping", spec.damping}};
    json::Object solver{{"precision", spec.real_bytes == 4 ? "float" : "double"}};
    if (spec.substeps > 0) solver.push_back({"substeps", double(spec.substeps)});
    if (spec.rate != 0) solver.push_back({"rate", spec.rate});
    return json::to_text(
        json::Object{{"sinew", 1.0}, {"dimension", double(dimension)}, {"world", world}, {"solver", solver}});
}

/// The spec's parameters as overrides of the only figure of a scene; empty where a name is missing.
bool overrides_of(const sinew_figure_spec& spec, std::vector<Override>& overrides) {
    for (std::uint32_t i = 0; i < spec.parameter_count; ++i) {
        const auto& parameter = spec.parameters[i];
        if (!parameter.name) return false;
        const auto value = parameter.word ? std::string(parameter.word) : json::to_text(parameter.number);
        overrides.push_back({concat("figures.0.", parameter.name, "=", value), "a parameter"});
    }
    return true;
}

std::string free_name(const AnyWorld& world, const std::string& stem) {
    const auto taken = [&](const std::string& name) {
        return std::visit([&](const auto& any) { return find_figure(any, name).has_value(); }, world);
    };
    auto name = stem;
    for (int number = 2; taken(name); ++number) name = concat(stem, "_", number);
    return name;
}

/// A scene of the units and the mode of another, with one figure.
std::string scene_with(const Scene& scene, const sinew_figure_spec& spec, const std::string& name) {
    json::Object figure{{"prefab", spec.prefab},
                        {"name", name},
                        {"at", list_of(spec.position, scene.dimension)},
                        {"velocity", list_of(spec.velocity, scene.dimension)}};
    json::Object units{{"length", scene.units.length}, {"time", scene.units.time}, {"up", scene.units.up}};
    json::Object solver{{"mode", scene.solver.mode}, {"precision", scene.solver.precision}};
    return json::to_text(json::Object{{"sinew", 1.0},
                                      {"dimension", double(scene.dimension)},
                                      {"units", units},
                                      {"solver", solver},
                                      {"figures", json::Array{figure}}});
}

sinew_status add_figure(Session& session, const sinew_figure_spec& spec, std::uint32_t* figure) {
    const auto wanted = spec.name ? std::string(spec.name) : free_name(session.world(), spec.prefab);
    std::vector<Override> overrides;
    if (!overrides_of(spec, overrides)) return null_argument();
    auto document = load(scene_with(session.scene(), spec, wanted), "sinew_figure_spec", overrides);
    auto opened = open_scene(document);
    if (const auto status = keep_diagnostics(document.diagnostics)) return status;
    auto& section = opened->scene.figures.front();
    section.turn = spec.turn;
    const std::string name(name_of(section)); // a parameter, too, may name it
    const auto find = [&] {
        return std::visit([&](const auto& world) { return find_figure(world, name); }, session.world());
    };
    if (find()) return fail(SINEW_BAD_ARGUMENT, concat("a figure is called ", in_quotes(name), " already"));
    sinew::add_figure(session.scene(), section, session.world());
    const auto added = *find();
    if (const auto steered = Steering::of(section)) {
        const auto id = std::visit([&](const auto& world) { return figure_id(world, added); }, session.world());
        session.steering().know(id, *steered);
    }
    if (figure) *figure = added;
    return SINEW_OK;
}

} // namespace

extern "C" {

sinew_status sinew_world_create(const sinew_world_spec* given, sinew_world* simulation) {
    sinew_world_spec spec;
    if (const auto status = take(given, spec)) return status;
    const auto dimension = spec.dimension == 0 ? 2 : spec.dimension;
    if (dimension != 2 && dimension != 3) return fail(SINEW_BAD_ARGUMENT, "a world has 2 or 3 dimensions");
    if (spec.real_bytes != 0 && spec.real_bytes != 4 && spec.real_bytes != 8)
        return fail(SINEW_BAD_ARGUMENT, "a number has 4 or 8 bytes");
    if (!is_finite(spec.gravity) || !std::isfinite(spec.damping) || !std::isfinite(spec.rate)) return not_finite();
    return sinew_world_open(scene_of(spec, int(dimension)).c_str(), nullptr, simulation);
}

sinew_status sinew_world_set_gravity(sinew_world simulation, sinew_point gravity) {
    if (!is_finite(gravity)) return not_finite();
    return change(simulation, [&](Session& session) {
        std::visit([&]<int D, class Real>(World<D, Real>& world) { set_gravity(world, vector_of<D, Real>(gravity)); },
                   session.world());
        return SINEW_OK;
    });
}

sinew_status sinew_world_add_figure(sinew_world simulation, const sinew_figure_spec* given, uint32_t* figure) {
    sinew_figure_spec spec;
    if (const auto status = take(given, spec)) return status;
    if (!spec.prefab || (spec.parameter_count > 0 && !spec.parameters)) return null_argument();
    if (!is_finite(spec.position) || !is_finite(spec.velocity) || !std::isfinite(spec.turn)) return not_finite();
    return change(simulation, [&](Session& session) { return ::add_figure(session, spec, figure); });
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
        const auto found = std::visit([&](const auto& world) { return find_figure(world, name); }, session.world());
        if (!found) return fail(SINEW_NOT_FOUND, concat("no figure is called ", in_quotes(name)));
        *figure = *found;
        return SINEW_OK;
    });
}

} // extern "C"

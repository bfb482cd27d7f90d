#include "sinew/constraint/kind_table.h"
#include "sinew/picture/overlay.h"
#include "sinew/prefab/prefabs.h"
#include "sinew/scene/parameters.h"
#include "sinew/scene/text.h"

#include "bindings/c/player.h"
#include "bindings/c/simulation.h"
#include "player/joints.h"
#include "player/tool.h"

#include <algorithm>
#include <array>

/// Descriptions of the engine and of a scene as JSON.
using namespace sinew;
using namespace sinew::c;

namespace {

json::Value schema() {
    return schema_of(scene_layout(), "Sinew scene", true);
}

/// Dimensions of the worlds in which a prefab can be built.
json::Array dimensions_of(std::string_view prefab) {
    json::Array all;
    const auto add = [&]<class Prefab>(const Prefab&) {
        for (const int dimension : {2, 3})
            if (Prefab::dimensions.include(dimension)) all.push_back(dimension);
    };
    if (const auto made = make_prefab(prefab)) std::visit(add, *made);
    return all;
}

json::Value prefabs() {
    json::Array all;
    const auto& parts = figure_layout().parts;
    const auto made =
        std::find_if(parts.begin(), parts.end(), [](const Layout& part) { return part.type == Layout::Type::choice; });
    for (const auto& one : made->parts)
        if (one.name != ByHand::name)
            all.push_back(json::Object{{"name", one.name},
                                       {"about", one.about},
                                       {"dimensions", dimensions_of(one.name)},
                                       {"parameters", parameters_of(one)}});
    return all;
}

template <std::size_t count> json::Array kinds_of(const std::array<KindInfo, count>& kinds) {
    json::Array all;
    for (const auto& kind : kinds) all.push_back(json::Object{{"name", kind.name}, {"particles", kind.min_arity}});
    return all;
}

json::Value kinds() {
    return json::Object{{"2", kinds_of(kinds_in<2>)}, {"3", kinds_of(kinds_in<3>)}};
}

json::Value all_overlays() {
    json::Array all;
    for (const auto& overlay : overlays) all.push_back(json::Object{{"name", overlay.name}, {"about", overlay.about}});
    return all;
}

json::Value tools() {
    json::Array all;
    for (const auto& tool : play::all_tools())
        all.push_back(json::Object{{"name", tool->name()}, {"key", tool->key()}, {"about", tool->about()}});
    return all;
}

json::Value joints() {
    json::Array all;
    for (const auto& joint : play::joints) all.push_back(json::Object{{"name", joint.name}, {"about", joint.about}});
    return all;
}

json::Value actions() {
    json::Array all;
    for (const auto& action : play::key_actions())
        if (is_of_scene(action.name))
            all.push_back(json::Object{{"name", action.name}, {"key", action.key}, {"about", action.about}});
    return all;
}

struct Topic {
    std::string_view name;
    json::Value (*describe)();
};
constexpr std::array topics = {Topic{"schema", schema},         Topic{"prefabs", prefabs}, Topic{"kinds", kinds},
                               Topic{"overlays", all_overlays}, Topic{"tools", tools},     Topic{"joints", joints},
                               Topic{"actions", actions}};

} // namespace

extern "C" {

sinew_status sinew_describe(const char* topic, const char** json) {
    if (!topic || !json) return null_argument();
    static thread_local std::string text;
    const auto found = std::find_if(topics.begin(), topics.end(), [&](const Topic& one) { return one.name == topic; });
    if (found == topics.end()) return fail(SINEW_BAD_ARGUMENT, concat("no topic is called ", in_quotes(topic)));
    text = json::to_text(found->describe());
    *json = text.c_str();
    return SINEW_OK;
}

sinew_status sinew_world_parameters(sinew_world simulation, const char** json) {
    if (!json) return null_argument();
    return read(simulation, [&](Simulation& known, const Session& session) {
        known.text = json::to_text(parameters_of(session.scene()));
        *json = known.text.c_str();
        return SINEW_OK;
    });
}

} // extern "C"

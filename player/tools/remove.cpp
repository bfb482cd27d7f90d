#include "sinew/scene/check.h"

#include "player/scene_edit.h"
#include "player/tool.h"

#include <algorithm>

namespace sinew::play {
namespace {

/// True if a name belongs to the figure or to a part of the figure.
bool belongs(std::string_view name, const std::string& figure) {
    return name == figure || name.starts_with(figure + "/");
}

/// The scene without a figure and all references to the figure.
Scene without(Scene scene, const std::string& figure) {
    std::erase_if(scene.figures, [&](const FigureSection& one) { return sinew::name_of(one) == figure; });
    std::erase_if(scene.pins, [&](const PinSection& pin) { return belongs(pin.particle, figure); });
    std::erase_if(scene.looks, [&](const auto& look) { return belongs(look.first, figure); });
    std::erase_if(scene.constraints, [&](const ConstraintSection& constraint) {
        return std::ranges::any_of(constraint.between, [&](const auto& name) { return belongs(name, figure); });
    });
    std::erase_if(scene.events, [&](const EventSection& event) {
        if (const auto* grab = std::get_if<GrabEvent>(&event.event)) return belongs(grab->particle, figure);
        if (const auto* release = std::get_if<ReleaseEvent>(&event.event)) return belongs(release->particle, figure);
        if (const auto* impulse = std::get_if<ImpulseEvent>(&event.event)) return belongs(impulse->target, figure);
        if (const auto* removal = std::get_if<RemoveEvent>(&event.event))
            return std::ranges::any_of(removal->names, [&](const auto& name) { return belongs(name, figure); });
        return false;
    });
    return scene;
}

class RemoveTool final : public Tool {
    std::string_view name() const override { return "remove"; }
    std::string_view key() const override { return "delete"; }
    std::string_view about() const override { return "deletes the figure under the pointer"; }

    void press(Play& play) override {
        const auto picked = play.pick_here();
        if (!picked) return;
        const auto figure = std::visit(
            [&](const auto& world) {
                return picked->figure < world.figures.size() ? world.figures[picked->figure].name : std::string();
            },
            play.session().world());
        if (figure.empty()) return;
        play.hovered.reset(), play.selected.reset();
        play.change([&](Scene& scene) { scene = without(std::move(scene), figure); }, "delete " + figure);
        play.tell("remove", {{"figure", figure}});
    }
};

} // namespace

std::unique_ptr<Tool> tool::remove() {
    return std::make_unique<RemoveTool>();
}

} // namespace sinew::play

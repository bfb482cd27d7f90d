#include "player/scene_edit.h"
#include "player/tool.h"

namespace sinew::play {
namespace {

class PinTool final : public Tool {
    std::string_view name() const override { return "pin"; }
    std::string_view key() const override { return "n"; }
    std::string_view about() const override { return "pins a particle where it is, or takes a pin of the scene off"; }

    void press(Play& play) override {
        const auto& session = play.session();
        if (const auto pinned = pin_near(play)) {
            const auto particle = session.scene().pins[*pinned].particle;
            play.change(
                [&](Scene& scene) {
                    std::erase_if(scene.pins, [&](const PinSection& pin) { return pin.particle == particle; });
                },
                "unpin");
            return play.tell("unpin", {{"particle", particle}});
        }
        const auto picked = play.pick_here();
        if (!picked) return;
        const auto name = name_of(session.world(), picked->members.front());
        if (name.find('/') == std::string::npos) return void(play.message = "this particle has no name to pin it by");
        play.change([&](Scene& scene) { pin_where_it_is(play, scene, name); }, "pin");
        play.tell("pin", {{"particle", name}});
    }

    static void pin_where_it_is(const Play& play, Scene& scene, const std::string& name) {
        const auto& world = play.session().world();
        const auto id = std::visit([&](const auto& any) { return find_particle(any, name); }, world);
        if (!id) return;
        auto& pin = scene.pins.emplace_back();
        pin.particle = name;
        pin.to = position_of(world, {&*id, 1});
    }

    /// The first pin of the scene within 18 nominal pixels of the pointer.
    static std::optional<std::size_t> pin_near(const Play& play) {
        constexpr double near = 18; // nominal pixels
        const auto& session = play.session();
        const auto view = play.view();
        for (std::size_t i = 0; i < session.scene().pins.size(); ++i) {
            const auto id =
                std::visit([&](const auto& world) { return find_particle(world, session.scene().pins[i].particle); },
                           session.world());
            const auto position = id ? position_of(session.world(), {&*id, 1}) : std::nullopt;
            const auto seen = position ? view.see(position->as<3, double>()) : std::nullopt;
            if (seen && distance(cast<double>(seen->pixel), play.pointer()) < near * play.density()) return i;
        }
        return std::nullopt;
    }
};

} // namespace

std::unique_ptr<Tool> tool::pin() {
    return std::make_unique<PinTool>();
}

} // namespace sinew::play

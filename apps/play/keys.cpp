#include "apps/play/keys.h"

#include <array>

namespace sinew::play {
namespace {

constexpr std::array actions = {
    KeyAction{"p", "pause, and go on", [](Play& play) { play.pause(!play.clock().paused()); }},
    KeyAction{"o", "one step", [](Play& play) { play.step(); }},
    KeyAction{"b", "one step back", [](Play& play) { play.step_back(); }},
    KeyAction{"r", "restart", [](Play& play) { play.restart(); }},
    KeyAction{"-", "slower", [](Play& play) { play.clock().set_scale(play.clock().scale() / 2); }},
    KeyAction{"=", "faster", [](Play& play) { play.clock().set_scale(play.clock().scale() * 2); }},
    KeyAction{"[", "scene before", [](Play& play) { play.open_neighbour(-1); }},
    KeyAction{"]", "next scene", [](Play& play) { play.open_neighbour(1); }},
    KeyAction{"home", "see everything", [](Play& play) { play.eye().home(play.session()); }},
    KeyAction{"u", "perspective or orthographic (3D)",
              [](Play& play) { play.eye().switch_projection(play.session()); }},
    KeyAction{"g", "gravity on or off", [](Play& play) { play.toggle_gravity(); }},
    KeyAction{"w", "wind on or off", [](Play& play) { play.toggle_wind(); }},
    KeyAction{"c", "classic or physical", [](Play& play) { play.switch_mode(); }},
    KeyAction{"t", "light or dark", [](Play& play) { play.switch_theme(); }},
    KeyAction{"s", "screenshot", [](Play& play) { play.screenshot(); }},
    KeyAction{"v", "record a film", [](Play& play) { play.toggle_recording(); }},
    KeyAction{"ctrl+z", "undo", [](Play& play) { play.undo(); }},
    KeyAction{"ctrl+y", "do again", [](Play& play) { play.redo(); }},
    KeyAction{"ctrl+s", "save", [](Play& play) { play.save_beside(); }},
    KeyAction{"y", "with the display, or as fast as can be",
              [](Play& play) { play.free_running = !play.free_running; }},
    KeyAction{"tab", "panel", [](Play& play) { play.panel = !play.panel; }},
    KeyAction{"f1", "this help", [](Play& play) { play.help = !play.help; }},
    KeyAction{"escape", "close, or quit", [](Play& play) { play.close(); }},
};

} // namespace

std::span<const KeyAction> key_actions() {
    return actions;
}

/// 1 to 9 are the overlays in their order.
void press_key(Play& play, std::string_view key) {
    if (key.size() == 1 && key[0] >= '1' && key[0] <= '9') {
        const auto number = std::size_t(key[0] - '1');
        if (number < overlays.size()) play.overlay.flip(number);
    }
    for (const auto& action : actions)
        if (action.key == key) action.act(play);
}

} // namespace sinew::play

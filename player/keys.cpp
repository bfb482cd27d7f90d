#include "player/keys.h"

#include "player/play.h"
#include "player/tool.h"

#include <algorithm>
#include <array>

namespace sinew::play {
namespace {

constexpr std::array actions = {
    KeyAction{"pause", "space", "pause, and go on", [](Play& play) { play.pause(!play.clock().paused()); }},
    KeyAction{"hold", "p", "pause, also where space makes somebody jump",
              [](Play& play) { play.pause(!play.clock().paused()); }},
    KeyAction{"step", "o", "one step", [](Play& play) { play.step(); }},
    KeyAction{"back", "b", "one step back", [](Play& play) { play.step_back(); }},
    KeyAction{"restart", "r", "restart", [](Play& play) { play.restart(); }},
    KeyAction{"slower", "-", "slower", [](Play& play) { play.clock().set_scale(play.clock().scale() / 2); }},
    KeyAction{"faster", "=", "faster", [](Play& play) { play.clock().set_scale(play.clock().scale() * 2); }},
    KeyAction{"previous_scene", "[", "scene before", [](Play& play) { play.open_neighbour(-1); }},
    KeyAction{"next_scene", "]", "next scene", [](Play& play) { play.open_neighbour(1); }},
    KeyAction{"see_all", "home", "see everything",
              [](Play& play) { play.each_pane([&] { play.camera().home(play.session()); }); }},
    KeyAction{"projection", "u", "perspective or orthographic (3D)",
              [](Play& play) { play.each_pane([&] { play.camera().switch_projection(play.session()); }); }},
    KeyAction{"gravity", "g", "gravity on or off", [](Play& play) { play.toggle_gravity(); }},
    KeyAction{"wind", "w", "wind on or off", [](Play& play) { play.toggle_wind(); }},
    KeyAction{"mode", "c", "classic or physical", [](Play& play) { play.switch_mode(); }},
    KeyAction{"split", "e", "classic and physical side by side", [](Play& play) { play.toggle_split(); }},
    KeyAction{"theme", "t", "light or dark", [](Play& play) { play.switch_theme(); }},
    KeyAction{"screenshot", "s", "screenshot", [](Play& play) { play.screenshot(); }},
    KeyAction{"film", "v", "record a film", [](Play& play) { play.toggle_recording(); }},
    KeyAction{"follow", "h", "the camera follows what is chosen, or the figure under the pointer",
              [](Play& play) { play.toggle_follow(); }},
    KeyAction{"choose_all", "ctrl+a", "choose everything", [](Play& play) { play.choose_all(); }},
    KeyAction{"duplicate", "ctrl+d", "copy what is chosen", [](Play& play) { play.duplicate_chosen(); }},
    KeyAction{"undo", "ctrl+z", "undo", [](Play& play) { play.undo(); }},
    KeyAction{"redo", "ctrl+y", "do again", [](Play& play) { play.redo(); }},
    KeyAction{"new", "ctrl+n", "new scene", [](Play& play) { play.open_new(); }},
    KeyAction{"open", "ctrl+o", "open a file", [](Play& play) { play.ask_for_path(Purpose::open); }},
    KeyAction{"save", "ctrl+s", "save", [](Play& play) { play.save_or_ask(); }},
    KeyAction{"save_as", "ctrl+shift+s", "save as", [](Play& play) { play.ask_for_path(Purpose::save); }},
    KeyAction{"copy", "ctrl+c", "copy the scene as text", [](Play& play) { play.copy_scene(); }},
    KeyAction{"paste", "ctrl+v", "open the scene in the clipboard", [](Play& play) { play.open_clipboard(); }},
    KeyAction{"free_running", "y", "with the display, or as fast as can be",
              [](Play& play) { play.free_running = !play.free_running; }},
    KeyAction{"panel", "tab", "panel", [](Play& play) { play.panel = !play.panel; }},
    KeyAction{"settings", "f2", "settings", [](Play& play) { play.settings = !play.settings; }},
    KeyAction{"help", "f1", "this help", [](Play& play) { play.help = !play.help; }},
    KeyAction{"close", "escape", "close, or quit", [](Play& play) { play.close(); }},
};

/// Calls visit(name, default key) for every action and tool.
template <class Visit> void for_each_key(Visit&& visit) {
    for (const auto& action : actions) visit(action.name, action.key);
    static const auto tools = all_tools();
    for (const auto& tool : tools) visit(tool->name(), tool->key());
}

} // namespace

std::span<const KeyAction> key_actions() {
    return actions;
}

std::string Keys::of(std::string_view name) const {
    for (const auto& [own, key] : chosen)
        if (own == name) return key;
    std::string found;
    for_each_key([&](std::string_view known, std::string_view key) {
        if (known == name) found = key;
    });
    return found;
}

std::string Keys::action_of(std::string_view key) const {
    std::string found;
    for_each_key([&](std::string_view name, std::string_view) {
        if (of(name) == key) found = name;
    });
    return found;
}

std::string Keys::choose(std::string_view name, std::string_view key) {
    if (auto taken = action_of(key); !taken.empty() && taken != name) return taken;
    std::erase_if(chosen, [&](const auto& own) { return own.first == name; });
    if (of(name) != key) chosen.emplace_back(name, key);
    return "";
}

/// Keys 1 to 9 toggle the overlays in their order.
void press_key(Play& play, std::string_view key) {
    if (key.size() == 1 && key[0] >= '1' && key[0] <= '9') {
        const auto number = std::size_t(key[0] - '1');
        if (number < overlays.size()) play.overlay.flip(number);
    }
    const auto name = play.keys.action_of(key);
    for (const auto& action : actions)
        if (action.name == name) action.act(play);
}

} // namespace sinew::play

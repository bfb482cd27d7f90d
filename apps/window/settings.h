#pragma once

#include "sinew/math/record.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sinew::window {

/// Settings kept between runs, in $XDG_CONFIG_HOME/sinew/window.json.
struct Settings {
    std::string theme; ///< empty: the theme of each scene
    int width = 1280, height = 720;
    bool panel = true;
    bool free_running = false;
    double text_size = 1;
    bool hint = true;
    std::vector<std::string> recent;
    std::vector<std::pair<std::string, std::string>> keys;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.theme, Field{.name = "theme", .help = "light or dark; empty: the theme of each scene"});
        visit(self.width,
              Field{.name = "width", .help = "Width of the window, nominal pixels", .low = 1, .high = 16384});
        visit(self.height,
              Field{.name = "height", .help = "Height of the window, nominal pixels", .low = 1, .high = 16384});
        visit(self.panel, Field{.name = "panel", .help = "True if the panel is shown"});
        visit(self.free_running, Field{.name = "free_running", .help = "True if pictures do not wait for the display"});
        visit(self.text_size, Field{.name = "text_size", .help = "Factor for letters and bars", .low = 0.5, .high = 4});
        visit(self.hint, Field{.name = "hint", .help = "True at the first start: begins with the tour"});
        visit(self.recent, Field{.name = "recent", .help = "Recent files, the latest first"});
        visit(self.keys, Field{.name = "keys", .help = "Changed keys of actions and tools"});
    }
};

/// Saved settings; the defaults if the file is missing or invalid.
Settings load_settings();
void save_settings(const Settings& settings);

/// Folder of recordings: $XDG_STATE_HOME/sinew/recordings; empty if HOME is not set.
std::filesystem::path recordings_path();
/// File of unsaved edits: $XDG_STATE_HOME/sinew/autosave.json; empty if HOME is not set.
std::filesystem::path draft_path();

} // namespace sinew::window

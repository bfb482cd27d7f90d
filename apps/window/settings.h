#pragma once

#include "apps/play/play.h"

#include <filesystem>
#include <string>

namespace sinew::window {

/// What is remembered from one time to the next, in $XDG_CONFIG_HOME/sinew/window.json.
struct Settings {
    std::string theme; ///< empty: as scenes say
    int width = 1280, height = 720;
    bool panel = true;
    bool free_running = false;

    template <class Self, class Visit> static void fields(Self& self, Visit&& visit) {
        visit(self.theme, Field{.name = "theme", .help = "light, dark, or as scenes say"});
        visit(self.width, Field{.name = "width", .help = "Of the window", .low = 1, .high = 16384});
        visit(self.height, Field{.name = "height", .help = "Of the window", .low = 1, .high = 16384});
        visit(self.panel, Field{.name = "panel", .help = "Whether the panel is shown"});
        visit(self.free_running, Field{.name = "free_running", .help = "Whether pictures do not wait for the display"});
    }
};

/// As they were saved; the usual ones where there are none or they cannot be read.
Settings load_settings();
void save_settings(const Settings& settings);

/// Saves an edited scene on exit, to $XDG_STATE_HOME/sinew/autosave.json, and tells where.
void keep_for_later(play::Play& play);

} // namespace sinew::window

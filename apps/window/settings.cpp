#include "apps/window/settings.h"

#include "sinew/scene/document.h"
#include "sinew/scene/reader.h"

#include "player/files.h"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace sinew::window {
namespace {

namespace fs = std::filesystem;

/// A folder of the XDG base directories; empty if HOME is not set.
fs::path folder(const char* variable, const char* usual) {
    const char* const own = std::getenv(variable);
    if (own && *own) return fs::path(own) / "sinew";
    const char* const home = std::getenv("HOME");
    return home && *home ? fs::path(home) / usual / "sinew" : fs::path();
}

fs::path settings_path() {
    const auto config = folder("XDG_CONFIG_HOME", ".config");
    return config.empty() ? fs::path() : config / "window.json";
}

} // namespace

Settings load_settings() {
    std::ifstream file(settings_path());
    std::ostringstream text;
    text << file.rdbuf();
    auto document = load(file ? text.str() : "{}", "window.json");
    Settings settings;
    read(document.root, settings, Reading{.diagnostics = document.diagnostics});
    return document.diagnostics.ok() ? settings : Settings{};
}

void save_settings(const Settings& settings) {
    const auto path = settings_path();
    if (path.empty()) return;
    (void)play::write_file(path, json::to_text(write(settings, Writing{})) + "\n"); // on failure: defaults next time
}

fs::path recordings_path() {
    const auto state = folder("XDG_STATE_HOME", ".local/state");
    return state.empty() ? fs::path() : state / "recordings";
}

fs::path draft_path() {
    const auto state = folder("XDG_STATE_HOME", ".local/state");
    return state.empty() ? fs::path() : state / "autosave.json";
}

} // namespace sinew::window

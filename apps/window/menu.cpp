#include "apps/window/menu.h"

#include "apps/window/label.h"

#include <filesystem>

namespace sinew::window {
namespace {

using play::Play;
using play::Purpose;

/// A menu entry with the key of the action, if any.
bool entry(const Play& play, const char* words, const char* action = "", bool possible = true) {
    const auto key = *action ? play.keys.of(action) : std::string();
    return ImGui::MenuItem(words, key.c_str(), false, possible);
}

void file_menu(Play& play) {
    if (entry(play, "New", "new")) play.open_new();
    if (entry(play, "Open\xe2\x80\xa6", "open")) play.ask_for_path(Purpose::open);
    if (ImGui::BeginMenu("Open recent", !play.recent.empty())) {
        const auto files = play.recent;
        for (const auto& file : files) {
            if (ImGui::MenuItem(std::filesystem::path(file).filename().c_str())) play.open(file);
            tooltip(file);
        }
        ImGui::EndMenu();
    }
    ImGui::Separator();
    if (entry(play, "Save", "save")) play.save_or_ask();
    if (entry(play, "Save as\xe2\x80\xa6", "save_as")) play.ask_for_path(Purpose::save);
    if (entry(play, "Save running state\xe2\x80\xa6")) play.ask_for_path(Purpose::save_state);
    tooltip("Open goes on from this moment.");
    if (entry(play, "Save recording")) play.save_recording();
    tooltip("All that happened since the scene was opened, for a report of a fault: sinew replay FILE.");
    ImGui::Separator();
    if (entry(play, "Export moment\xe2\x80\xa6")) play.ask_for_path(Purpose::picture);
    if (play.recording() ? entry(play, "End the export", "film") : entry(play, "Export film or model\xe2\x80\xa6"))
        play.recording() ? play.toggle_recording() : play.ask_for_path(Purpose::film);
    ImGui::Separator();
    if (entry(play, "Settings\xe2\x80\xa6", "settings")) play.settings = true;
    if (entry(play, "Quit", "close")) play.ask_to_quit();
}

void edit_menu(Play& play) {
    const auto undo = play.timeline().undo_name(), redo = play.timeline().redo_name();
    if (entry(play, ("Undo " + undo).c_str(), "undo", !undo.empty())) play.undo();
    if (entry(play, ("Redo " + redo).c_str(), "redo", !redo.empty())) play.redo();
    ImGui::Separator();
    if (entry(play, "Choose everything", "choose_all")) play.choose_all();
    if (entry(play, "Duplicate", "duplicate", !play.chosen.empty())) play.duplicate_chosen();
    if (entry(play, "Delete", "remove", !play.chosen.empty())) play.remove(std::vector(play.chosen));
    ImGui::Separator();
    if (entry(play, "Copy scene as text", "copy")) play.copy_scene();
    if (entry(play, "Run scene from clipboard", "paste")) play.open_clipboard();
}

void view_menu(Play& play) {
    const auto& mode = play.session().scene().solver.mode;
    const bool split = play.is_split();
    if (ImGui::MenuItem("Physical", nullptr, !split && mode == "physical")) play.show_mode("physical");
    if (ImGui::MenuItem("Classic", nullptr, !split && mode == "classic")) play.show_mode("classic");
    if (ImGui::MenuItem("Both, side by side", play.keys.of("split").c_str(), split)) play.toggle_split();
    ImGui::Separator();
    for (std::size_t i = 0; i < overlays.size(); ++i) {
        const std::string name(overlays[i].name), key = std::to_string(i + 1);
        if (ImGui::MenuItem(name.c_str(), key.c_str(), play.overlay.test(i))) play.overlay.flip(i);
        tooltip(std::string(overlays[i].about));
    }
    ImGui::Separator();
    if (entry(play, "See everything", "see_all")) play.each_pane([&] { play.camera().home(play.session()); });
    if (ImGui::MenuItem("Camera follows", play.keys.of("follow").c_str(), play.followed.has_value()))
        play.toggle_follow();
    if (entry(play, "Light or dark", "theme")) play.switch_theme();
    if (entry(play, "Panel and bars", "panel")) play.panel = false;
}

template <class Show> void menu(const char* name, Show&& show) {
    if (!ImGui::BeginMenu(name)) return;
    show();
    ImGui::EndMenu();
}

} // namespace

void menu_bar(Play& play, bool docked, bool& drawer) {
    if (!ImGui::BeginMenuBar()) return;
    menu("File", [&] { file_menu(play); });
    menu("Edit", [&] { edit_menu(play); });
    menu("View", [&] { view_menu(play); });
    menu("Help", [&] {
        if (entry(play, "Keys", "help")) play.help = true;
        if (entry(play, "Tour")) play.tour.begin();
    });
    if (!docked) {
        const char* const word = drawer ? "Hide panel" : "Panel";
        const float width = ImGui::CalcTextSize(word).x + 3 * ImGui::GetStyle().ItemSpacing.x;
        ImGui::SetCursorPosX(ImGui::GetWindowWidth() - width);
        if (ImGui::MenuItem(word)) drawer = !drawer;
        tooltip("scenes, parameters, inspector and statistics");
    }
    ImGui::EndMenuBar();
}

} // namespace sinew::window

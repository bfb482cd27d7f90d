#include "apps/window/panel.h"

#include "apps/play/keys.h"
#include "apps/play/tool.h"
#include "apps/window/bars.h"
#include "apps/window/inspector.h"
#include "apps/window/sliders.h"

#include <algorithm>

namespace sinew::window {
namespace {

/// Nominal pixels.
constexpr float side_width = 340, tools_width = 56, time_height = 64;
constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

/// A part of the panel, with a hairline around it.
void begin_fixed(const char* name, float left, float top, float width, float height) {
    ImGui::SetNextWindowPos({left, top});
    ImGui::SetNextWindowSize({width, height});
    ImGui::Begin(name, nullptr, fixed_window);
    const auto line = ImGui::GetColorU32(ImGuiCol_Border);
    ImGui::GetWindowDrawList()->AddRect({left, top}, {left + width, top + height}, line);
}

} // namespace

void Panel::dress(double density) {
    window::dress(look_called(play_.shown_theme()), density, density_, fonts_);
    ImGui::GetIO().FontDefault = fonts_.normal;
}

/// A window too small for the panel is all scene.
Area Panel::area(int width, int height) {
    width_ = width, height_ = height;
    const auto scale = float(density_);
    const bool room = float(width) > (side_width + tools_width) * scale * 1.5F && float(height) > 260 * scale;
    if (!play_.panel || !room) return {0, 0, width, height};
    const int left = int(tools_width * scale), right = int(side_width * scale), bottom = int(time_height * scale);
    return {left, 0, width - left - right, height - bottom};
}

void Panel::show() {
    const auto scale = float(density_);
    const auto area = this->area(width_, height_);
    statistics_.sample(play_);
    if (area.width < width_) {
        begin_fixed("tools", 0, 0, float(area.left), float(area.height));
        tool_bar(play_, look_called(play_.shown_theme()), scale);
        ImGui::End();
        begin_fixed("time", 0, float(area.height), float(width_ - int(side_width * scale)),
                    float(height_ - area.height));
        time_bar(play_, look_called(play_.shown_theme()), fonts_, scale);
        ImGui::End();
        begin_fixed("side", float(area.left + area.width), 0, side_width * scale, float(height_));
        side();
        ImGui::End();
    }
    message();
    if (play_.help) help();
    problem();
}

bool Panel::section(const char* name, bool open) {
    ImGui::Dummy({0, 2 * float(density_)});
    const auto& look = look_called(play_.shown_theme());
    ImGui::PushStyleColor(ImGuiCol_Header, ImVec4{0, 0, 0, 0});
    ImGui::PushStyleColor(ImGuiCol_Text, look.text);
    ImGui::PushFont(fonts_.small);
    const bool shown = ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    ImGui::PopFont();
    ImGui::PopStyleColor(2);
    return shown;
}

void Panel::title() {
    const auto& look = look_called(play_.shown_theme());
    ImGui::PushFont(fonts_.large);
    auto name = play_.scene_name();
    if (const auto slash = name.find_last_of('/'); slash != std::string::npos) name = name.substr(slash + 1);
    std::replace(name.begin(), name.end(), '_', ' ');
    if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = char(name[0] - 'a' + 'A');
    ImGui::TextUnformatted(name.c_str());
    ImGui::PopFont();
    ImGui::PushFont(fonts_.small);
    ImGui::PushStyleColor(ImGuiCol_Text, look.faint);
    auto about = play_.session().scene().about;
    if (const auto stop = about.find(". "); stop != std::string::npos) about.resize(stop + 1);
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(about.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::Dummy({0, 2 * float(density_)});
    mode_switch(play_, look, float(density_));
}

void Panel::side() {
    const auto& look = look_called(play_.shown_theme());
    title();
    if (play_.tool == "spawn" && section("PREFAB", true)) prefab_form(play_, look);
    if (section("SCENES", true)) browser_.show(look, fonts_, float(density_));
    if (section("PARAMETERS", false)) sliders(play_, look, fonts_);
    if (section("OVERLAYS", false)) overlay_chips(play_, look);
    if (section("INSPECTOR", true)) inspector(play_, look, fonts_);
    if (section("STATISTICS", true)) statistics_.show(play_, look, fonts_, float(density_));
    ImGui::Dummy({0, 12});
}

/// A line over the scene that goes away by itself.
void Panel::message() {
    constexpr double shown = 3; // seconds
    if (play_.message != last_message_) last_message_ = play_.message, message_since_ = ImGui::GetTime();
    const double age = ImGui::GetTime() - message_since_;
    if (last_message_.empty() || age > shown) return;
    const auto& look = look_called(play_.shown_theme());
    const auto area = this->area(width_, height_);
    const auto size = ImGui::CalcTextSize(last_message_.c_str());
    const auto scale = float(density_);
    const float x = float(area.left) + (float(area.width) - size.x) / 2, y = float(area.height) - size.y - 26 * scale;
    const float alpha = float(std::min(1.0, (shown - age) * 2));
    auto& list = *ImGui::GetForegroundDrawList();
    list.AddRectFilled({x - 14 * scale, y - 8 * scale}, {x + size.x + 14 * scale, y + size.y + 8 * scale},
                       packed(look.text, 0.88F * alpha), 999);
    list.AddText({x, y}, packed(look.surface, alpha), last_message_.c_str());
}

void Panel::problem() {
    constexpr const char* name = "This scene cannot be played";
    if (!play_.problem().empty() && !ImGui::IsPopupOpen(name)) ImGui::OpenPopup(name);
    ImGui::SetNextWindowSize({std::min(float(width_) * 0.8F, 780 * float(density_)), 0});
    ImGui::SetNextWindowPos({float(width_) / 2, float(height_) / 2}, ImGuiCond_Always, {0.5F, 0.5F});
    if (!ImGui::BeginPopupModal(name, nullptr, ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove)) return;
    ImGui::BeginChild("text", {0, 240 * float(density_)}, false, ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::PushFont(fonts_.fixed);
    ImGui::TextUnformatted(play_.problem().c_str());
    ImGui::PopFont();
    ImGui::EndChild();
    if (ImGui::Button("Go on with the scene that runs") || play_.problem().empty()) {
        play_.dismiss_problem();
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void Panel::help() {
    const auto& look = look_called(play_.shown_theme());
    const auto scale = float(density_);
    const auto area = this->area(width_, height_);
    const ImVec2 middle{float(area.left) + float(area.width) / 2, float(area.top) + float(area.height) / 2};
    ImGui::SetNextWindowPos(middle, ImGuiCond_Always, {0.5F, 0.5F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 12 * scale);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(26 * scale, 22 * scale));
    ImGui::Begin("help", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushFont(fonts_.large);
    ImGui::TextUnformatted("Keys");
    ImGui::PopFont();
    const auto line = [&](std::string_view key, std::string_view about) {
        ImGui::TableNextColumn();
        ImGui::TextColored(look.accent, "%.*s", int(key.size()), key.data());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(about.data(), about.data() + about.size());
    };
    ImGui::PushStyleVar(ImGuiStyleVar_CellPadding, ImVec2(10 * scale, 3 * scale));
    if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) {
        for (const auto& action : play::key_actions()) line(action.key, action.about);
        for (const auto& tool : play::all_tools()) line(tool->key(), std::string(tool->name()) + " tool");
        line("1 to 4", "overlays");
        line("drag", "take hold and throw");
        line("right drag", "cut");
        line("middle drag", "look elsewhere");
        line("wheel", "zoom");
        ImGui::EndTable();
    }
    ImGui::PopStyleVar();
    ImGui::End();
    ImGui::PopStyleVar(2);
}

} // namespace sinew::window

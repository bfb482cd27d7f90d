#include "apps/window/panel.h"

#include "apps/window/bars.h"
#include "apps/window/figure_form.h"
#include "apps/window/inspector.h"
#include "apps/window/label.h"
#include "apps/window/menu.h"
#include "apps/window/sliders.h"

#include <algorithm>
#include <filesystem>
#include <imgui_internal.h>
#include <utility>

namespace sinew::window {
namespace {

/// Bars never take the focus when they appear, so that an open question keeps it.
constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                          ImGuiWindowFlags_NoFocusOnAppearing;

/// Begins a part of the panel, with a hairline around.
void begin_fixed(const char* name, const Area& area, ImGuiWindowFlags more = 0) {
    const ImVec2 corner{float(area.left), float(area.top)}, size{float(area.width), float(area.height)};
    ImGui::SetNextWindowPos(corner);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin(name, nullptr, fixed_window | more);
    const auto line = ImGui::GetColorU32(ImGuiCol_Border);
    auto& list = *ImGui::GetWindowDrawList();
    list.PushClipRectFullScreen();
    list.AddRect(corner, {corner.x + size.x, corner.y + size.y}, line);
    list.PopClipRect();
}

} // namespace

void Panel::arrange(int width, int height, double density) {
    width_ = width, height_ = height;
    const double scale = density * text_size();
    scale_ = float(scale);
    window::dress(look(), scale, dressed_scale_, fonts_);
    ImGui::GetIO().FontDefault = fonts_.normal;
    layout_ = Arrangement::of(width, height, scale_, play_.panel, drawer_);
}

bool Panel::leaves_to_scene(double x, double y) const {
    return layout_.scene.contains(x, y) && !layout_.side.contains(x, y) && !popup_open_ && !play_.help;
}

/// Escape closes a menu or a list, or leaves a text field; dialogs are closed by Play::close().
bool Panel::take_key(const std::string& key) {
    if (dialogs_.take_key(key)) return true;
    if (key != "escape" || dialogs_.is_open()) return false;
    if (popup_open_) return close_menus_ = true;
    return ImGui::GetIO().WantTextInput;
}

void Panel::show() {
    // ImGui may have closed the popup since the key was pressed.
    if (std::exchange(close_menus_, false) && ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup))
        ImGui::ClosePopupToLevel(0, true);
    statistics_.sample(play_);
    if (layout_.bars) {
        menu();
        begin_fixed("tools", layout_.tools);
        tool_bar(play_, layout_, look(), scale_);
        ImGui::End();
        begin_fixed("time", layout_.time);
        time_bar(play_, layout_, look(), fonts_, scale_);
        ImGui::End();
        if (layout_.docked || drawer_) {
            begin_fixed("side", layout_.side);
            side();
            ImGui::End();
        }
    }
    message();
    tour();
    dialogs_.show(look(), fonts_, scale_, width_, height_);
    popup_open_ = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

void Panel::menu() {
    const float padding = (float(layout_.menu.height) - ImGui::GetFontSize()) / 2;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(9 * scale_, std::max(padding, 0.0F)));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    begin_fixed("menu", layout_.menu, ImGuiWindowFlags_MenuBar);
    ImGui::PopStyleVar(3);
    menu_bar(play_, layout_.docked, drawer_);
    ImGui::End();
}

bool Panel::section(const char* name, const char* help, bool open) {
    ImGui::Dummy({0, 2 * scale_});
    ImGui::PushStyleColor(ImGuiCol_Header, ImVec4{0, 0, 0, 0});
    ImGui::PushStyleColor(ImGuiCol_Text, look().text);
    ImGui::PushFont(fonts_.small);
    const bool shown = ImGui::CollapsingHeader(name, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
    ImGui::PopFont();
    ImGui::PopStyleColor(2);
    tooltip(help);
    return shown;
}

void Panel::title() {
    ImGui::PushFont(fonts_.large);
    auto name = std::filesystem::path(play_.scene_name()).stem().string();
    std::replace(name.begin(), name.end(), '_', ' ');
    if (!name.empty() && name[0] >= 'a' && name[0] <= 'z') name[0] = char(name[0] - 'a' + 'A');
    ImGui::TextUnformatted(name.c_str());
    ImGui::PopFont();
    ImGui::PushFont(fonts_.small);
    ImGui::PushStyleColor(ImGuiCol_Text, look().faint);
    auto about = play_.session().scene().about;
    if (const auto stop = about.find(". "); stop != std::string::npos) about.resize(stop + 1);
    ImGui::PushTextWrapPos();
    ImGui::TextUnformatted(about.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
    ImGui::Dummy({0, 2 * scale_});
    mode_switch(play_, look(), scale_);
}

void Panel::side() {
    title();
    if (play_.tool == "spawn" && section("PREFAB", "what the spawn tool puts in, and how it is made", true))
        prefab_form(play_, look());
    if (play_.tool == "join" && section("JOINT", "what the join tool makes, from one figure to another", true))
        joint_form(play_, look());
    if (!chosen_figures(play_).empty() && section("FIGURE", "looks and contact of the chosen figures", true))
        figure_form(play_, look(), scale_);
    if (section("SCENES", "the catalogue: press one to open it", true)) browser_.show(look(), fonts_, scale_);
    if (section("PARAMETERS", "numbers of the world, the solver and every figure: drag them", false))
        sliders(play_, look(), fonts_);
    if (section("OVERLAYS", "what can be laid over the scene to see into it", false)) overlay_chips(play_, look());
    if (section("INSPECTOR", "the particle that was pressed last, or that the pointer is over", true))
        inspector(play_, look(), fonts_);
    if (section("PLOT", "curves of any quantity: of everything, or of the selected particle", false))
        statistics_.plots(play_, look(), fonts_, scale_);
    if (section("STATISTICS", "counts, times and energies of the running scene", true))
        statistics_.show(play_, look(), fonts_, scale_);
    ImGui::Dummy({0, 12 * scale_});
}

/// Text over the scene at the fraction `share` of the height, wrapped to the scene's width.
void Panel::write_over_scene(const std::string& text, float share, float alpha) {
    const auto& area = layout_.scene;
    const float inset = 14 * scale_, wrap = std::max(float(area.width) - 4 * inset, 60.0F);
    const auto size = ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap);
    const float x = float(area.left) + (float(area.width) - size.x) / 2;
    const float y = float(area.top) + (float(area.height) - size.y - 3 * inset) * share + inset;
    auto& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({x - inset, y - inset / 2}, {x + size.x + inset, y + size.y + inset / 2},
                       packed(look().text, 0.88F * alpha), 16 * scale_);
    list.AddText(nullptr, 0, {x, y}, packed(look().surface, alpha), text.c_str(), nullptr, wrap);
}

/// Shows the last message for four seconds.
void Panel::message() {
    constexpr double shown = 4; // seconds
    if (play_.message != last_message_) last_message_ = play_.message, message_since_ = ImGui::GetTime();
    const double age = ImGui::GetTime() - message_since_;
    if (last_message_.empty() || age > shown) return;
    write_over_scene(last_message_, 1, float(std::min(1.0, (shown - age) * 2)));
}

/// The line of the tour.
void Panel::tour() {
    if (play_.tour.is_on() && !play_.has_dialog()) write_over_scene(play_.tour.text(), 0.06F, 1);
}

} // namespace sinew::window

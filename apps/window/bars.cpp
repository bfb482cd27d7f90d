#include "apps/window/bars.h"

#include "apps/play/tool.h"
#include "apps/window/icons.h"

#include <algorithm>
#include <cstdio>

namespace sinew::window {
namespace {

/// A square with an icon; `on` fills it.
bool icon_button(std::string_view icon, float side, bool on, const Look& look, const std::string& tip) {
    const auto at = ImGui::GetCursorScreenPos();
    const std::string id = "##" + std::string(icon) + tip;
    const bool pressed = ImGui::InvisibleButton(id.c_str(), {side, side});
    const bool hovered = ImGui::IsItemHovered();
    auto& list = *ImGui::GetWindowDrawList();
    if (on || hovered)
        list.AddRectFilled(at, {at.x + side, at.y + side}, packed(on ? look.accent : look.raised), side * 0.22F);
    draw_icon(list, icon, {at.x + side / 2, at.y + side / 2}, side * 0.27F, packed(on ? look.on_accent : look.text));
    if (hovered && !tip.empty()) {
        ImGui::BeginTooltip();
        ImGui::TextUnformatted(tip.c_str());
        ImGui::EndTooltip();
    }
    return pressed;
}

/// Some words of which one is chosen, in one frame. The number of the one that is pressed, or -1.
int choice(const char* id, std::initializer_list<const char*> words, int chosen, const Look& look, float width) {
    const auto at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight(), each = width / float(words.size());
    auto& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, packed(look.raised), height * 0.3F);
    int pressed = -1, number = 0;
    ImGui::PushID(id);
    for (const char* word : words) {
        const ImVec2 corner{at.x + each * float(number), at.y};
        ImGui::SetCursorScreenPos(corner);
        ImGui::PushID(number);
        if (ImGui::InvisibleButton("word", {each, height})) pressed = number;
        ImGui::PopID();
        const float inset = 2;
        if (number == chosen)
            list.AddRectFilled({corner.x + inset, corner.y + inset},
                               {corner.x + each - inset, corner.y + height - inset}, packed(look.surface),
                               height * 0.26F);
        const auto size = ImGui::CalcTextSize(word);
        list.AddText({corner.x + (each - size.x) / 2, corner.y + (height - size.y) / 2},
                     packed(number == chosen ? look.text : look.faint), word);
        ++number;
    }
    ImGui::PopID();
    return pressed;
}

std::string clock_text(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%d:%05.2f", int(seconds) / 60, seconds - double(int(seconds) / 60 * 60));
    return text;
}

/// The last minute as a line; where it is pressed is gone to.
void timeline(play::Play& play, const Look& look, float width, float scale) {
    auto& tape = play.tape();
    const auto at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight(), middle = at.y + height / 2;
    ImGui::InvisibleButton("timeline", {std::max(width, 1.0F), height});
    const auto first = double(tape.first()), length = std::max(double(tape.end()) - first, 1.0);
    if (ImGui::IsItemActive()) {
        const float share = std::clamp((ImGui::GetIO().MousePos.x - at.x) / std::max(width, 1.0F), 0.0F, 1.0F);
        const auto step = std::uint64_t(first + double(share) * length + 0.5);
        if (step != tape.now()) play.go_to(step);
    }
    const float here = at.x + width * float((double(tape.now()) - first) / length);
    const float thick = 4 * scale;
    auto& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x, middle - thick / 2}, {at.x + width, middle + thick / 2}, packed(look.raised), thick);
    list.AddRectFilled({at.x, middle - thick / 2}, {here, middle + thick / 2}, packed(look.accent), thick);
    list.AddCircleFilled({here, middle}, 7 * scale, packed(look.accent), 24);
    list.AddCircleFilled({here, middle}, 3 * scale, packed(look.surface), 24);
}

} // namespace

void tool_bar(play::Play& play, const Look& look, float scale) {
    const float side = 40 * scale;
    ImGui::SetCursorPos({8 * scale, 10 * scale});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 4 * scale));
    ImGui::BeginGroup();
    static const auto tools = play::all_tools();
    for (const auto& tool : tools) {
        const auto tip =
            std::string(tool->name()) + "  (" + std::string(tool->key()) + ")\n" + std::string(tool->about());
        if (icon_button(tool->name(), side, play.tool == tool->name(), look, tip)) play.tool = tool->name();
    }
    ImGui::Dummy({0, 6 * scale});
    if (icon_button("undo", side, false, look, "undo " + play.tape().undo_name())) play.undo();
    if (icon_button("redo", side, false, look, "do again " + play.tape().redo_name())) play.redo();
    ImGui::EndGroup();
    ImGui::PopStyleVar();
}

void time_bar(play::Play& play, const Look& look, const Fonts& fonts, float scale) {
    const float side = 38 * scale, top = 13 * scale;
    ImGui::SetCursorPos({14 * scale, top});
    if (icon_button("restart", side, false, look, "restart (r)")) play.restart();
    ImGui::SameLine(0, 2 * scale);
    if (icon_button("back", side, false, look, "one step back (b)")) play.step_back();
    ImGui::SameLine(0, 2 * scale);
    const bool paused = play.clock().paused();
    if (icon_button(paused ? "play" : "pause", side, true, look, paused ? "go on (p)" : "pause (p)"))
        play.pause(!paused);
    ImGui::SameLine(0, 2 * scale);
    if (icon_button("step", side, false, look, "one step (o)")) play.step();
    ImGui::SameLine(0, 14 * scale);
    ImGui::SetCursorPosY(top + (side - ImGui::GetTextLineHeight()) / 2);
    ImGui::PushFont(fonts.fixed);
    ImGui::TextUnformatted(clock_text(play.session().seconds()).c_str());
    ImGui::PopFont();
    ImGui::SameLine(0, 14 * scale);
    const float speeds = 190 * scale;
    const float room = ImGui::GetWindowWidth() - ImGui::GetCursorPosX() - speeds - 34 * scale;
    ImGui::SetCursorPosY(top + (side - ImGui::GetFrameHeight()) / 2);
    timeline(play, look, room, scale);
    ImGui::SameLine(0, 18 * scale);
    ImGui::SetCursorPosY(top + (side - ImGui::GetFrameHeight()) / 2);
    constexpr std::array scales = {0.1, 0.25, 0.5, 1.0, 2.0};
    int chosen = -1;
    for (std::size_t i = 0; i < scales.size(); ++i)
        if (play.clock().scale() == scales[i]) chosen = int(i);
    const int pressed = choice("speed", {"0.1", "\xc2\xbc", "\xc2\xbd", "1", "2"}, chosen, look, speeds);
    if (pressed >= 0) play.clock().set_scale(scales[std::size_t(pressed)]);
}

void mode_switch(play::Play& play, const Look& look, float scale) {
    const float width = ImGui::GetContentRegionAvail().x, gap = 8 * scale;
    const auto at = ImGui::GetCursorScreenPos();
    const bool classic = play.session().scene().solver.mode == "classic";
    const int mode = choice("mode", {"physical", "classic"}, classic ? 1 : 0, look, (width - gap) * 0.58F);
    if (mode >= 0 && (mode == 1) != classic) play.switch_mode();
    ImGui::SetCursorScreenPos({at.x + (width - gap) * 0.58F + gap, at.y});
    const bool dark = play.shown_theme() == "dark";
    const int theme = choice("theme", {"light", "dark"}, dark ? 1 : 0, look, (width - gap) * 0.42F);
    if (theme >= 0 && (theme == 1) != dark) play.switch_theme();
    ImGui::SetCursorScreenPos({at.x, at.y + ImGui::GetFrameHeight()});
    ImGui::Dummy({0, 0});
}

void overlay_chips(play::Play& play, const Look& look) {
    for (std::size_t i = 0; i < overlays.size(); ++i) {
        const bool on = play.overlay.test(i);
        ImGui::PushStyleColor(ImGuiCol_Button, on ? look.accent : look.raised);
        ImGui::PushStyleColor(ImGuiCol_Text, on ? look.on_accent : look.text);
        if (ImGui::Button(std::string(overlays[i].name).c_str())) play.overlay.flip(i);
        ImGui::PopStyleColor(2);
        if (ImGui::IsItemHovered()) {
            ImGui::BeginTooltip();
            ImGui::TextUnformatted(overlays[i].about.data(), overlays[i].about.data() + overlays[i].about.size());
            ImGui::EndTooltip();
        }
        ImGui::SameLine();
    }
    ImGui::NewLine();
}

} // namespace sinew::window

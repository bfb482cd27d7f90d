#include "apps/window/bars.h"

#include "apps/window/label.h"
#include "player/tool.h"

#include <algorithm>
#include <cstdio>

namespace sinew::window {
namespace {

std::string clock_text(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, "%d:%05.2f", int(seconds) / 60, seconds - double(int(seconds) / 60 * 60));
    return text;
}

/// The last minute as a line; a press or drag goes to the step at the pointer.
void timeline(play::Play& play, const Look& look, float width, float scale) {
    auto& timeline = play.timeline();
    const auto at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight(), middle = at.y + height / 2;
    ImGui::InvisibleButton("timeline", {std::max(width, 1.0F), height});
    const auto first = double(timeline.first()), length = std::max(double(timeline.end()) - first, 1.0);
    if (ImGui::IsItemActive()) {
        const float share = std::clamp((ImGui::GetIO().MousePos.x - at.x) / std::max(width, 1.0F), 0.0F, 1.0F);
        const auto step = std::uint64_t(first + double(share) * length + 0.5);
        if (step != timeline.now()) play.go_to(step);
    }
    const float here = at.x + width * float((double(timeline.now()) - first) / length);
    const float thick = 4 * scale;
    auto& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({at.x, middle - thick / 2}, {at.x + width, middle + thick / 2}, packed(look.raised), thick);
    list.AddRectFilled({at.x, middle - thick / 2}, {here, middle + thick / 2}, packed(look.accent), thick);
    list.AddCircleFilled({here, middle}, 7 * scale, packed(look.accent), 24);
    list.AddCircleFilled({here, middle}, 3 * scale, packed(look.surface), 24);
}

} // namespace

void tool_bar(play::Play& play, const Arrangement& layout, const Look& look, float scale) {
    const float side = layout.tool_side, gap = 4 * scale, left = 8 * scale, top = 10 * scale;
    int number = 0;
    const auto button = [&](std::string_view icon, bool on, const std::string& tip) {
        const int column = number % layout.tool_columns, row = number / layout.tool_columns;
        ++number;
        ImGui::SetCursorPos({left + float(column) * (side + gap), top + float(row) * (side + gap)});
        return icon_button(icon, side, on, look, tip);
    };
    static const auto tools = play::all_tools();
    for (const auto& tool : tools) {
        const auto name = std::string(tool->name());
        const auto tip = name + "  (" + play.keys.of(name) + ")\n" + std::string(tool->about());
        if (button(tool->name(), play.tool == name, tip)) play.tool = name;
    }
    const auto with_key = [&](const char* word, const std::string& what, const char* action) {
        return std::string(word) + (what.empty() ? "" : " " + what) + "  (" + play.keys.of(action) + ")";
    };
    if (button("undo", false, with_key("undo", play.timeline().undo_name(), "undo"))) play.undo();
    if (button("redo", false, with_key("do again", play.timeline().redo_name(), "redo"))) play.redo();
}

namespace {

constexpr std::array scales = {0.1, 0.25, 0.5, 1.0, 2.0};
constexpr std::array scale_words = {"0.1", "\xc2\xbc", "\xc2\xbd", "1", "2"};

/// Index of the clock's scale in `scales`, or -1.
int chosen_scale(play::Play& play) {
    for (std::size_t i = 0; i < scales.size(); ++i)
        if (play.clock().scale() == scales[i]) return int(i);
    return -1;
}

/// A choice between all speeds, or without room for them a button with the current speed, which a press advances.
void speeds(play::Play& play, const Look& look, float width, bool all) {
    const int chosen = chosen_scale(play);
    if (all) {
        const int pressed = choice("speed",
                                   {{scale_words[0], "a tenth of the speed"},
                                    {scale_words[1], "a quarter of the speed"},
                                    {scale_words[2], "half the speed"},
                                    {scale_words[3], "a second takes a second"},
                                    {scale_words[4], "twice the speed"}},
                                   chosen, look, width);
        if (pressed >= 0) play.clock().set_scale(scales[std::size_t(pressed)]);
        return;
    }
    char text[16];
    std::snprintf(text, sizeof text, "%.3g\xc3\x97", play.clock().scale());
    const std::string word = chosen >= 0 ? scale_words[std::size_t(chosen)] + std::string("\xc3\x97") : text;
    if (ImGui::Button((word + "##speed").c_str(), {width, 0}))
        play.clock().set_scale(scales[std::size_t(chosen + 1) % scales.size()]);
    tooltip("speed of time: press for the next");
}

} // namespace

void time_bar(play::Play& play, const Arrangement& layout, const Look& look, const Fonts& fonts, float scale) {
    const float side = layout.time_side, top = (float(layout.time.height) - side) / 2;
    const bool roomy = float(layout.time.width) > 560 * scale;
    const float gap = (roomy ? 14 : 8) * scale;
    ImGui::SetCursorPos({gap, top});
    const auto with_key = [&](const char* word, const char* action) {
        return std::string(word) + "  (" + play.keys.of(action) + ")";
    };
    if (icon_button("restart", side, false, look, with_key("restart", "restart"))) play.restart();
    ImGui::SameLine(0, 2 * scale);
    if (icon_button("back", side, false, look, with_key("one step back", "back"))) play.step_back();
    ImGui::SameLine(0, 2 * scale);
    const bool paused = play.clock().paused();
    if (icon_button(paused ? "play" : "pause", side, true, look, with_key(paused ? "go on" : "pause", "pause")))
        play.pause(!paused);
    ImGui::SameLine(0, 2 * scale);
    if (icon_button("step", side, false, look, with_key("one step", "step"))) play.step();
    ImGui::SameLine(0, gap);
    ImGui::SetCursorPosY(top + (side - ImGui::GetTextLineHeight()) / 2);
    ImGui::PushFont(fonts.fixed);
    ImGui::TextUnformatted(clock_text(play.session().seconds()).c_str());
    ImGui::PopFont();
    tooltip("seconds since the scene's start, minutes before the colon");
    ImGui::SameLine(0, gap);
    const float speed_width = (roomy ? 190 : 52) * scale;
    const float room = ImGui::GetWindowWidth() - ImGui::GetCursorPosX() - speed_width - 2 * gap;
    if (room > 40 * scale) {
        ImGui::SetCursorPosY(top + (side - ImGui::GetFrameHeight()) / 2);
        timeline(play, look, room, scale);
        ImGui::SameLine(0, gap);
    }
    ImGui::SetCursorPosY(top + (side - ImGui::GetFrameHeight()) / 2);
    speeds(play, look, speed_width, roomy);
}

void mode_switch(play::Play& play, const Look& look, float scale) {
    const float width = ImGui::GetContentRegionAvail().x, gap = 8 * scale;
    const auto at = ImGui::GetCursorScreenPos();
    const bool classic = play.session().scene().solver.mode == "classic";
    constexpr float share = 0.64F;
    const int now = play.is_split() ? 2 : classic ? 1 : 0;
    const int mode = choice("mode",
                            {{"physical", "as it should be: nothing stretches, energy is kept"},
                             {"classic", "as the original demo behaved, with its faults"},
                             {"both", "classic and physical side by side, from the start"}},
                            now, look, (width - gap) * share);
    if (mode == 2 && now != 2) play.toggle_split();
    if (mode >= 0 && mode < 2 && mode != now) play.show_mode(mode == 1 ? "classic" : "physical");
    ImGui::SetCursorScreenPos({at.x + (width - gap) * share + gap, at.y});
    const bool dark = play.shown_theme() == "dark";
    const int theme = choice("theme", {{"light", "dark on light"}, {"dark", "light on dark"}}, dark ? 1 : 0, look,
                             (width - gap) * (1 - share));
    if (theme >= 0 && (theme == 1) != dark) play.switch_theme();
    ImGui::SetCursorScreenPos({at.x, at.y + ImGui::GetFrameHeight()});
    ImGui::Dummy({0, 0});
}

/// Places as many chips in a line as fit.
void overlay_chips(play::Play& play, const Look& look) {
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    for (std::size_t i = 0; i < overlays.size(); ++i) {
        const bool on = play.overlay.test(i);
        const std::string name(overlays[i].name);
        const auto& style = ImGui::GetStyle();
        const float width = ImGui::CalcTextSize(name.c_str()).x + 2 * style.FramePadding.x;
        if (i > 0 && ImGui::GetItemRectMax().x + style.ItemSpacing.x + width < right) ImGui::SameLine();
        ImGui::PushStyleColor(ImGuiCol_Button, on ? look.accent : look.raised);
        ImGui::PushStyleColor(ImGuiCol_Text, on ? look.on_accent : look.text);
        if (ImGui::Button(name.c_str())) play.overlay.flip(i);
        ImGui::PopStyleColor(2);
        tooltip(std::string(overlays[i].about) + "  (" + std::to_string(i + 1) + ")");
    }
}

} // namespace sinew::window

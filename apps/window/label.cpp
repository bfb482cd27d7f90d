#include "apps/window/label.h"

#include "apps/window/icons.h"

namespace sinew::window {

std::string elided(const std::string& text, float width) {
    if (ImGui::CalcTextSize(text.c_str()).x <= width) return text;
    for (auto length = text.size(); length-- > 1;) {
        if ((static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) continue; // inside a UTF-8 character
        auto shorter = text.substr(0, length) + "\xe2\x80\xa6";
        if (ImGui::CalcTextSize(shorter.c_str()).x <= width) return shorter;
    }
    return "";
}

void tooltip(const std::string& text) {
    if (text.empty() || !ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 26);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void label(const std::string& name, const std::string& help, const ImVec4& color, float share) {
    const float start = ImGui::GetCursorPosX();
    const float column = ImGui::GetContentRegionAvail().x * share;
    ImGui::AlignTextToFramePadding();
    const auto shown = elided(name, column - ImGui::GetStyle().ItemSpacing.x);
    ImGui::TextColored(color, "%s", shown.c_str());
    tooltip(shown == name ? help : name + ": " + help);
    ImGui::SameLine(start + column);
    ImGui::SetNextItemWidth(-1);
}

void row(const std::string& name, const std::string& help, const std::string& value, const Look& look) {
    label(name, help, look.faint);
    const auto shown = elided(value, ImGui::GetContentRegionAvail().x);
    ImGui::TextUnformatted(shown.c_str());
    if (shown != value) tooltip(value);
}

std::string number_format(const char* number, const std::string& unit) {
    return unit.empty() ? number : number + (" " + unit);
}

int choice(const char* id, const std::vector<Choice>& words, int chosen, const Look& look, float width) {
    const auto at = ImGui::GetCursorScreenPos();
    const float height = ImGui::GetFrameHeight(), each = width / float(words.size());
    auto& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, packed(look.raised), height * 0.3F);
    int pressed = -1, number = 0;
    ImGui::PushID(id);
    for (const auto& [word, help] : words) {
        const ImVec2 corner{at.x + each * float(number), at.y};
        ImGui::SetCursorScreenPos(corner);
        ImGui::PushID(number);
        if (ImGui::InvisibleButton("word", {each, height})) pressed = number;
        tooltip(help);
        ImGui::PopID();
        const float inset = height * 0.08F;
        if (number == chosen)
            list.AddRectFilled({corner.x + inset, corner.y + inset},
                               {corner.x + each - inset, corner.y + height - inset}, packed(look.surface),
                               height * 0.26F);
        const auto shown = elided(word, each);
        const auto size = ImGui::CalcTextSize(shown.c_str());
        list.AddText({corner.x + (each - size.x) / 2, corner.y + (height - size.y) / 2},
                     packed(number == chosen ? look.text : look.faint), shown.c_str());
        ++number;
    }
    ImGui::PopID();
    return pressed;
}

bool icon_button(std::string_view icon, float side, bool on, const Look& look, const std::string& tip) {
    const auto at = ImGui::GetCursorScreenPos();
    const std::string id = "##" + std::string(icon) + tip;
    const bool pressed = ImGui::InvisibleButton(id.c_str(), {side, side});
    const bool hovered = ImGui::IsItemHovered();
    auto& list = *ImGui::GetWindowDrawList();
    if (on || hovered)
        list.AddRectFilled(at, {at.x + side, at.y + side}, packed(on ? look.accent : look.raised), side * 0.22F);
    draw_icon(list, icon, {at.x + side / 2, at.y + side / 2}, side * 0.27F, packed(on ? look.on_accent : look.text));
    tooltip(tip);
    return pressed;
}

} // namespace sinew::window

#include "apps/window/browser.h"

#include <algorithm>

namespace sinew::window {
namespace {

std::string words_of(std::string name) {
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

} // namespace

/// Three cards in a row, two rows in view.
void Browser::show(const Look& look, const Fonts& fonts, float scale) {
    constexpr int across = 3;
    const float gap = 8 * scale, width = (ImGui::GetContentRegionAvail().x - gap * (across - 1) - 10 * scale) / across;
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##search", "search scenes", search_.data(), search_.size());
    const float height = width * 0.75F + ImGui::GetTextLineHeight() + 10 * scale;
    ImGui::BeginChild("scenes", {0, height * 2 + gap * 2 + ImGui::GetTextLineHeight()}, false);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(gap, gap));
    const auto& library = play_.library();
    int number = 0;
    std::string_view category;
    bool any = false;
    for (std::size_t i = 0; i < library.names.size(); ++i) {
        const auto& name = library.names[i];
        const std::string_view of = i < library.categories.size() ? std::string_view(library.categories[i]) : "";
        const auto found = [&](const std::string& text) { return text.find(search_.data()) != std::string::npos; };
        if (!found(words_of(name)) && !found(name) && !found(std::string(of))) continue;
        any = true;
        if (of != category) {
            ImGui::PushFont(fonts.small);
            ImGui::TextColored(look.accent, "%s", std::string(of).c_str());
            ImGui::PopFont();
            number = 0;
        }
        category = of;
        if (number++ % across != 0) ImGui::SameLine();
        card(name, width, look, fonts);
    }
    if (!any) ImGui::TextColored(look.faint, "nothing is called so");
    ImGui::PopStyleVar();
    ImGui::EndChild();
}

void Browser::card(const std::string& name, float width, const Look& look, const Fonts& fonts) {
    const float picture = width * 0.75F, rounding = width * 0.07F;
    ImGui::BeginGroup();
    const auto at = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(name.c_str(), {width, picture});
    auto& list = *ImGui::GetWindowDrawList();
    const ImVec2 corner{at.x + width, at.y + picture};
    list.AddRectFilled(at, corner, packed(look.raised), rounding);
    if (ImGui::IsItemVisible())
        if (const auto texture = thumbnails_.of(name, play_.shown_theme()))
            list.AddImageRounded(reinterpret_cast<ImTextureID>(std::intptr_t(texture)), at, corner, {0, 0}, {1, 1},
                                 IM_COL32_WHITE, rounding);
    const bool current = name == play_.scene_name(), hovered = ImGui::IsItemHovered();
    list.AddRect(at, corner, packed(current || hovered ? look.accent : look.line), rounding, 0, current ? 2.5F : 1);
    ImGui::PushFont(fonts.small);
    const auto words = words_of(name);
    const ImVec2 below{at.x, corner.y + 3};
    list.PushClipRect(below, {corner.x, below.y + ImGui::GetTextLineHeight() + 2}, true);
    list.AddText(below, packed(current ? look.accent : look.text), words.c_str());
    list.PopClipRect();
    ImGui::Dummy({width, ImGui::GetTextLineHeight()});
    ImGui::PopFont();
    ImGui::EndGroup();
    if (pressed && !current) play_.open(name);
}

} // namespace sinew::window

#include "apps/window/figure_form.h"

#include "sinew/scene/check.h"
#include "sinew/scene/text.h"

#include "apps/window/label.h"
#include "player/joints.h"

#include <algorithm>
#include <vector>

namespace sinew::window {
namespace {

const FigureSection* section_called(const play::Play& play, const std::string& name) {
    const auto& figures = play.session().scene().figures;
    const auto found =
        std::ranges::find(figures, name, [](const auto& figure) { return std::string(sinew::name_of(figure)); });
    return found == figures.end() ? nullptr : &*found;
}

/// Sets one value of every chosen figure; `goes_on` while a widget is dragged.
void set_all(play::Play& play, const std::vector<std::string>& names, const std::string& field,
             const json::Value& value, bool goes_on) {
    for (const auto& name : names)
        if (!play.set("figures." + name + "." + field, json::to_text(value), goes_on)) return;
}

bool is_dragged() {
    return ImGui::IsItemActive() && !ImGui::IsItemActivated();
}

std::optional<Color> own_color(const play::Play& play, const FigureSection& section) {
    for (const auto& [part, look] : section.looks)
        if (part == "all") return color_in(theme_called(play.shown_theme()), look.color);
    return std::nullopt;
}

/// The theme's colours, and any other.
void colors(play::Play& play, const std::vector<std::string>& names, const FigureSection& section, const Look& look,
            float scale) {
    label("colour", "of all parts of the figure", look.text);
    const auto& theme = theme_called(play.shown_theme());
    const float side = ImGui::GetFrameHeight();
    for (std::size_t i = 0; i < theme.palette.size(); ++i) {
        const auto& color = theme.palette[i];
        const ImVec4 shown{color.red, color.green, color.blue, 1};
        ImGui::PushID(int(i));
        if (ImGui::ColorButton("##swatch", shown, ImGuiColorEditFlags_NoTooltip, {side * 0.8F, side}))
            set_all(play, names, "looks.all.color", json::Value(hex_of(color)), false);
        ImGui::PopID();
        ImGui::SameLine(0, 3 * scale);
    }
    const auto now = own_color(play, section).value_or(theme.palette[0]);
    float numbers[3] = {now.red, now.green, now.blue};
    if (ImGui::ColorEdit3("##color", numbers, ImGuiColorEditFlags_NoInputs))
        set_all(play, names, "looks.all.color", json::Value(hex_of({numbers[0], numbers[1], numbers[2]})),
                is_dragged());
    tooltip("any colour");
}

void slider(play::Play& play, const std::vector<std::string>& names, const char* name, const char* help, double value,
            double most, const Look& look) {
    label(name, help, look.text);
    constexpr double least = 0;
    const std::string id = std::string("##") + name;
    if (ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &value, &least, &most, "%.3g"))
        set_all(play, names, std::string("contact.") + name, json::Value(value), is_dragged());
}

void contact(play::Play& play, const std::vector<std::string>& names, const FigureSection& section, const Look& look) {
    const auto truth = [&](const char* name, const char* field, const char* help, bool value) {
        label(name, help, look.text);
        if (ImGui::Checkbox((std::string("##") + name).c_str(), &value))
            set_all(play, names, std::string("contact.") + field, json::Value(value), false);
    };
    truth("touches figures", "figures", "contact with other figures that have this on (physical mode)",
          section.contact.figures);
    truth("touches itself", "itself", "contact of its parts with each other", section.contact.itself);
    slider(play, names, "friction", "Coulomb's coefficient against other figures; the smaller one counts",
           section.contact.friction, 2, look);
    slider(play, names, "wall_friction", "the same against walls and obstacles; theirs if never set",
           section.contact.wall_friction.value_or(section.contact.friction), 2, look);
    slider(play, names, "bounce", "share of the speed given back; of two that touch the larger one counts",
           section.contact.bounce, 1, look);
}

} // namespace

std::vector<std::string> chosen_figures(const play::Play& play) {
    std::vector<std::string> names;
    for (const auto& part : play.chosen)
        if (!part.is_obstacle && section_called(play, part.name)) names.push_back(part.name);
    if (names.empty() && play.chosen.empty() && play.selected)
        if (auto name = play.figure_name(*play.selected); section_called(play, name)) names.push_back(std::move(name));
    return names;
}

void figure_form(play::Play& play, const Look& look, float scale) {
    const auto names = chosen_figures(play);
    const auto* section = names.empty() ? nullptr : section_called(play, names.front());
    if (!section) return;
    const auto own = *section; // an edit replaces the scene
    std::string all = names.front();
    for (std::size_t i = 1; i < names.size(); ++i) all += ", " + names[i];
    ImGui::TextColored(look.accent, "%s", elided(all, ImGui::GetContentRegionAvail().x).c_str());
    colors(play, names, own, look, scale);
    contact(play, names, own, look);
    if (ImGui::Button("Copy")) {
        if (play.chosen.empty()) play.choose(play::Part{names.front(), false}, false);
        play.duplicate_chosen();
    }
    ImGui::SameLine();
    if (ImGui::Button("Delete")) {
        std::vector<play::Part> parts;
        for (const auto& name : names) parts.push_back({name, false});
        play.remove(parts);
    }
}

void joint_form(play::Play& play, const Look& look) {
    std::vector<Choice> words;
    for (const auto& joint : play::joints) words.push_back({joint.name.data(), joint.about.data()});
    const auto* chosen = std::ranges::find(play::joints, play.joint, &play::Joint::name);
    const int pressed =
        choice("joint", words, int(chosen - play::joints.begin()), look, ImGui::GetContentRegionAvail().x);
    if (pressed >= 0) play.joint = play::joints[std::size_t(pressed)].name;
    ImGui::PushTextWrapPos();
    if (chosen != play::joints.end()) ImGui::TextColored(look.faint, "%s", chosen->about.data());
    ImGui::PopTextWrapPos();
}

} // namespace sinew::window

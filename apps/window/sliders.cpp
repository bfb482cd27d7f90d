#include "apps/window/sliders.h"

#include "sinew/scene/check.h"
#include "sinew/scene/layout.h"
#include "sinew/scene/text.h"

#include "apps/play/scene_edit.h"

#include <algorithm>
#include <cmath>

namespace sinew::window {
namespace {

/// Walks a layout beside what the scene says, and shows what can be changed.
class Form {
  public:
    Form(play::Play& play, const Look& look) : play_(play), look_(look), units_(play.session().scene().measures()) {}

    void record(const Layout& layout, const json::Value* value, const std::string& path) {
        for (const auto& part : layout.parts) field(part, value, path);
    }

  private:
    play::Play& play_;
    const Look& look_;
    Units units_;

    static const json::Value* member(const json::Value* value, std::string_view key) {
        const auto* object = value ? value->as<json::Object>() : nullptr;
        const auto* found = object ? json::find(*object, key) : nullptr;
        return found ? &found->value : nullptr;
    }

    void field(const Layout& part, const json::Value* value, const std::string& path) {
        using Type = Layout::Type;
        const auto name = std::string(part.field.name);
        const auto* own = member(value, name);
        const auto here = path + "." + name;
        switch (part.type) {
        case Type::truth:
            return truth(part, own, here);
        case Type::integer:
        case Type::number:
            return number(part, own, here);
        case Type::text:
            return word(part, own, here);
        case Type::point:
            return point(part, own, here);
        case Type::choice:
            return alternative(part, value, path);
        case Type::record:
            if (!part.optional || own) record(part, own, here);
            return;
        default:
            return; // lists and maps are for an editor of text
        }
    }

    /// The fields of the alternative that the object says it is.
    void alternative(const Layout& part, const json::Value* value, const std::string& path) {
        const auto* said = member(value, part.field.name);
        const auto* name = said ? said->as<std::string>() : nullptr;
        for (const auto& one : part.parts)
            if (name && one.name == *name) record(one, value, path);
    }

    void label(const Layout& part) const {
        auto name = std::string(part.field.name);
        std::replace(name.begin(), name.end(), '_', ' ');
        const auto unit = units_.text(part.field.unit);
        ImGui::AlignTextToFramePadding();
        ImGui::TextColored(look_.text, "%s", name.c_str());
        if (ImGui::IsItemHovered()) {
            const auto help = std::string(part.field.help) + (unit.empty() ? "" : " (" + unit + ")");
            ImGui::SetTooltip("%s", help.c_str());
        }
        ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.42F);
        ImGui::SetNextItemWidth(-1);
    }

    static std::string id(const std::string& path) { return "##" + path; }

    void set(const std::string& path, const std::string& value) {
        const bool goes_on = ImGui::IsItemActive() && !ImGui::IsItemActivated();
        play_.set(path, value, goes_on);
    }

    void truth(const Layout& part, const json::Value* own, const std::string& path) {
        const auto* usual = part.usual.as<bool>();
        const auto* said = own ? own->as<bool>() : nullptr;
        bool value = said ? *said : usual && *usual;
        label(part);
        if (ImGui::Checkbox(id(path).c_str(), &value)) set(path, value ? "true" : "false");
    }

    void word(const Layout& part, const json::Value* own, const std::string& path) {
        if (part.field.choices.empty()) return;
        const auto* said = own ? own->as<std::string>() : part.usual.as<std::string>();
        label(part);
        if (!ImGui::BeginCombo(id(path).c_str(), said ? said->c_str() : "")) return;
        for (const auto choice : part.field.choices) {
            const std::string text(choice);
            if (ImGui::Selectable(text.c_str(), said && *said == text)) play_.set(path, text);
        }
        ImGui::EndCombo();
    }

    /// Narrow ranges are sliders; in wide ones the pointer moves a number in parts of itself.
    void number(const Layout& part, const json::Value* own, const std::string& path) {
        const auto* said = own ? own->as<json::Number>() : nullptr;
        const auto* usual = part.usual.as<json::Number>();
        if (!said && !usual && part.optional) return;
        double value = said ? said->value : usual ? usual->value * units_.scale(part.field.unit) : 0;
        const auto range = range_in_file(part.field, units_);
        label(part);
        bool changed = false;
        const bool whole = part.type == Layout::Type::integer;
        const char* const format = whole ? "%.0f" : "%.4g";
        if (range.low > -1e4 && range.high <= 1000 && range.high - range.low <= 1000) {
            changed =
                ImGui::SliderScalar(id(path).c_str(), ImGuiDataType_Double, &value, &range.low, &range.high, format);
        } else {
            const auto speed =
                float(std::max(std::fabs(value) * 0.01, whole ? 0.2 : 1e-4 * units_.scale(part.field.unit)));
            changed = ImGui::DragScalar(id(path).c_str(), ImGuiDataType_Double, &value, speed, &range.low, &range.high,
                                        format);
        }
        if (!changed) return;
        value = std::clamp(whole ? std::round(value) : value, range.low, range.high);
        set(path, number_text(value));
    }

    void point(const Layout& part, const json::Value* own, const std::string& path) {
        const auto* said = own ? own->as<json::Array>() : nullptr;
        if (!said && part.optional) return;
        const int dimension = play_.session().scene().dimension;
        std::array<double, 3> value{};
        double largest = 0;
        for (int i = 0; i < dimension; ++i) {
            const auto* item =
                said && std::size_t(i) < said->size() ? (*said)[std::size_t(i)].as<json::Number>() : nullptr;
            value[std::size_t(i)] = item ? item->value : 0;
            largest = std::max(largest, std::fabs(value[std::size_t(i)]));
        }
        label(part);
        const auto speed = float(std::max(largest * 0.01, 0.002 * units_.scale(part.field.unit)));
        if (!ImGui::DragScalarN(id(path).c_str(), ImGuiDataType_Double, value.data(), dimension, speed, nullptr,
                                nullptr, "%.4g"))
            return;
        std::string text = "[";
        for (int i = 0; i < dimension; ++i) text += (i ? "," : "") + number_text(value[std::size_t(i)]);
        set(path, text + "]");
    }
};

} // namespace

void sliders(play::Play& play, const Look& look, const Fonts& fonts) {
    static const Layout scene_layout = layout_of<Scene>();
    const auto document = play::document_of(play.session().scene());
    const auto& root = *document.as<json::Object>();
    Form form(play, look);
    const auto title = [&](const std::string& text) {
        ImGui::PushFont(fonts.small);
        ImGui::TextColored(look.accent, "%s", text.c_str());
        ImGui::PopFont();
    };
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ImGui::GetStyle().ItemSpacing.x, 4));
    for (const auto& part : scene_layout.parts) {
        const auto name = std::string(part.field.name);
        const auto* own = json::find(root, name);
        if (name == "solver" || name == "world") {
            title(name);
            form.record(part, own ? &own->value : nullptr, name);
        }
        const auto* figures = name == "figures" && own ? own->value.as<json::Array>() : nullptr;
        if (!figures) continue;
        constexpr std::size_t most = 12; // figures: a crowd is for the file
        for (std::size_t i = 0; i < std::min(figures->size(), most); ++i) {
            title(std::string(sinew::name_of(play.session().scene().figures[i])));
            form.record(part.parts.front(), &(*figures)[i], "figures." + std::to_string(i));
        }
    }
    ImGui::PopStyleVar();
}

} // namespace sinew::window

#include "apps/window/sliders.h"

#include "sinew/scene/check.h"
#include "sinew/scene/parameters.h"
#include "sinew/scene/text.h"

#include "apps/window/label.h"
#include "player/scene_edit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace sinew::window {
namespace {

/// Shows the fields of a layout, with the values of a scene, as widgets.
class Form {
  public:
    /// Applies a new value to a path; the flag is set while a widget is dragged, after the first change.
    using Setter = std::function<void(const std::string&, const json::Value&, bool)>;

    Form(const Scene& scene, const Look& look, Setter setter)
        : look_(look), units_(scene.measures()), dimension_(scene.dimension), mode_(scene.solver.mode),
          setter_(std::move(setter)) {}

    void record(const Layout& layout, const json::Value* value, const std::string& path) {
        for (const auto& part : layout.parts) field(part, value, path);
    }

  private:
    const Look& look_;
    Units units_;
    int dimension_;
    std::string mode_;
    Setter setter_;

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
        if (!acts_in(mode_, here)) return;
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
            return; // lists and maps are left to a text editor
        }
    }

    /// Shows the fields of the alternative named in the object.
    void alternative(const Layout& part, const json::Value* value, const std::string& path) {
        const auto* said = member(value, part.field.name);
        const auto* name = said ? said->as<std::string>() : nullptr;
        for (const auto& one : part.parts)
            if (name && one.name == *name) record(one, value, path);
    }

    std::string unit_of(const Layout& part, const std::string& path) const {
        return unit_text(part, path, units_, mode_);
    }

    /// Vectors show their unit beside the name, because several numbers share the field.
    void label(const Layout& part, const std::string& unit = "") const {
        auto name = std::string(part.field.name);
        std::replace(name.begin(), name.end(), '_', ' ');
        const auto with_unit = unit.empty() ? name : name + ", " + unit;
        const auto help = std::string(part.field.help);
        window::label(with_unit, help.empty() ? with_unit : help, look_.text);
    }

    static std::string id(const std::string& path) { return "##" + path; }

    void set(const std::string& path, const json::Value& value) {
        setter_(path, value, ImGui::IsItemActive() && !ImGui::IsItemActivated());
    }

    void truth(const Layout& part, const json::Value* own, const std::string& path) {
        const auto* usual = part.usual.as<bool>();
        const auto* said = own ? own->as<bool>() : nullptr;
        bool value = said ? *said : usual && *usual;
        label(part);
        if (ImGui::Checkbox(id(path).c_str(), &value)) set(path, value);
    }

    void word(const Layout& part, const json::Value* own, const std::string& path) {
        if (part.field.choices.empty()) return;
        const auto* said = own ? own->as<std::string>() : part.usual.as<std::string>();
        label(part);
        if (!ImGui::BeginCombo(id(path).c_str(), said && !said->empty() ? said->c_str() : "as usual")) return;
        for (const auto choice : part.field.choices) {
            const std::string text(choice);
            if (ImGui::Selectable(text.c_str(), said && *said == text)) setter_(path, text, false);
        }
        ImGui::EndCombo();
    }

    /// A slider for a narrow range; for a wide one, a drag proportional to the number.
    void number(const Layout& part, const json::Value* own, const std::string& path) {
        const auto* said = own ? own->as<json::Number>() : nullptr;
        const auto* usual = part.usual.as<json::Number>();
        if (!said && !usual && part.optional) return;
        double value = said ? said->value : usual ? usual->value * units_.scale(part.field.unit) : 0;
        const auto range = range_in_file(part.field, units_);
        label(part);
        bool changed = false;
        const bool whole = part.type == Layout::Type::integer;
        const auto format = number_format(whole ? "%.0f" : "%.4g", unit_of(part, path));
        if (range.low > -1e4 && range.high <= 1000 && range.high - range.low <= 1000) {
            changed = ImGui::SliderScalar(id(path).c_str(), ImGuiDataType_Double, &value, &range.low, &range.high,
                                          format.c_str());
        } else {
            const auto speed =
                float(std::max(std::fabs(value) * 0.01, whole ? 0.2 : 1e-4 * units_.scale(part.field.unit)));
            changed = ImGui::DragScalar(id(path).c_str(), ImGuiDataType_Double, &value, speed, &range.low, &range.high,
                                        format.c_str());
        }
        if (!changed) return;
        value = std::clamp(whole ? std::round(value) : value, range.low, range.high);
        set(path, whole ? json::Value(std::int64_t(value)) : json::Value(value));
    }

    void point(const Layout& part, const json::Value* own, const std::string& path) {
        const auto* said = own ? own->as<json::Array>() : nullptr;
        if (!said && part.optional) return;
        std::array<double, 3> value{};
        double largest = 0;
        for (int i = 0; i < dimension_; ++i) {
            const auto* item =
                said && std::size_t(i) < said->size() ? (*said)[std::size_t(i)].as<json::Number>() : nullptr;
            value[std::size_t(i)] = item ? item->value : 0;
            largest = std::max(largest, std::fabs(value[std::size_t(i)]));
        }
        label(part, unit_of(part, path));
        const auto speed = float(std::max(largest * 0.01, 0.002 * units_.scale(part.field.unit)));
        if (!ImGui::DragScalarN(id(path).c_str(), ImGuiDataType_Double, value.data(), dimension_, speed, nullptr,
                                nullptr, "%.4g"))
            return;
        json::Array numbers;
        for (int i = 0; i < dimension_; ++i) numbers.push_back(value[std::size_t(i)]);
        set(path, std::move(numbers));
    }
};

/// False, too, for a name of no prefab.
bool exists_in(int dimension, std::string_view name) {
    const auto included = [&]<class Prefab>(const Prefab&) { return Prefab::dimensions.include(dimension); };
    const auto prefab = make_prefab(name);
    return prefab && std::visit(included, *prefab);
}

} // namespace

void sliders(play::Play& play, const Look& look, const Fonts& fonts) {
    const auto document = to_json(play.session().scene());
    const auto& root = *document.as<json::Object>();
    Form form(play.session().scene(), look, [&](const std::string& path, const json::Value& value, bool goes_on) {
        play.set(path, json::to_text(value), goes_on);
    });
    const auto title = [&](const std::string& text) {
        ImGui::PushFont(fonts.small);
        ImGui::TextColored(look.accent, "%s", text.c_str());
        ImGui::PopFont();
    };
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ImGui::GetStyle().ItemSpacing.x, 4));
    const auto section = [&](const Layout& layout, const std::string& name) {
        const auto* own = json::find(root, name);
        title(name);
        form.record(layout, own ? &own->value : nullptr, name);
    };
    section(section_layout("world"), "world");
    section(section_layout("solver"), "solver");
    const auto* own = json::find(root, "figures");
    if (const auto* figures = own ? own->value.as<json::Array>() : nullptr) {
        constexpr std::size_t max = 12; // figures; larger crowds are edited in the file
        for (std::size_t i = 0; i < std::min(figures->size(), max); ++i) {
            title(std::string(sinew::name_of(play.session().scene().figures[i])));
            form.record(figure_layout(), &(*figures)[i], "figures." + std::to_string(i));
        }
    }
    ImGui::PopStyleVar();
}

void prefab_form(play::Play& play, const Look& look) {
    const auto& parts = figure_layout().parts;
    const auto made =
        std::find_if(parts.begin(), parts.end(), [](const Layout& part) { return part.type == Layout::Type::choice; });
    if (made == parts.end()) return;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##prefab", play.prefab.c_str())) {
        for (const auto& one : made->parts) {
            const std::string name(one.name);
            if (!exists_in(play.session().scene().dimension, name)) continue;
            if (!ImGui::Selectable(name.c_str(), name == play.prefab)) continue;
            play.prefab = name;
            play.prefab_parameters.clear();
        }
        ImGui::EndCombo();
    }
    Form form(play.session().scene(), look, [&](const std::string& path, const json::Value& value, bool) {
        const auto key = path.substr(path.find('.') + 1);
        if (auto* member = json::find(play.prefab_parameters, key))
            member->value = value;
        else
            play.prefab_parameters.push_back({key, value});
    });
    const json::Value said = play.prefab_parameters;
    for (const auto& one : made->parts)
        if (one.name == play.prefab) form.record(one, &said, "prefab");
}

} // namespace sinew::window

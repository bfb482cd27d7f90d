#include "sinew/scene/parameters.h"

#include "sinew/scene/check.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace sinew {
namespace {

/// Fields of the solver and of figures that have an effect in one mode only.
struct OfMode {
    std::string_view path, mode;
};
constexpr std::array parts_of_modes = {OfMode{"solver.rules", "classic"},      OfMode{"solver.passes", "classic"},
                                       OfMode{"solver.substeps", "physical"},  OfMode{"solver.iterations", "physical"},
                                       OfMode{"solver.direct", "physical"},    OfMode{"figures.direct", "physical"},
                                       OfMode{"figures.integrator", "classic"}};

/// Units of fields whose unit is not one of the scene's units.
struct Measured {
    std::string_view path, mode, unit;
};
constexpr std::array measured_otherwise = {Measured{"solver.rate", "", "a second"},
                                           Measured{"world.damping", "classic", "kept a frame"},
                                           Measured{"solver.rules.time_scale", "", "times as fast"},
                                           Measured{"solver.rules.longest_step", "", "frames"},
                                           Measured{"solver.rules.floor_keep", "", "kept a frame"},
                                           Measured{"solver.passes", "", "a frame"},
                                           Measured{"solver.substeps", "", "a step"},
                                           Measured{"solver.iterations", "", "a substep"}};

/// Path of a figure's field without the figure's number.
std::string of_any_figure(const std::string& path) {
    constexpr std::string_view figures = "figures";
    const auto number = path.starts_with(figures) ? path.find('.', figures.size() + 1) : std::string::npos;
    return number == std::string::npos ? path : std::string(figures) + path.substr(number);
}

const json::Value* stated_in(const json::Value* value, std::string_view key) {
    const auto* object = value ? value->as<json::Object>() : nullptr;
    const auto* found = object ? json::find(*object, key) : nullptr;
    return found ? &found->value : nullptr;
}

/// Collects the fields of records, with the values of a scene.
class ParameterCollector {
  public:
    ParameterCollector(const Units& units, int dimension, std::string_view mode, json::Array& found)
        : units_(units), dimension_(dimension), mode_(mode), found_(found) {}

    void record(const Layout& layout, const json::Value* value, const std::string& path) {
        for (const auto& part : layout.parts) field(part, value, path);
    }

  private:
    using Type = Layout::Type;
    const Units& units_;
    int dimension_;
    std::string_view mode_;
    json::Array& found_;

    void field(const Layout& part, const json::Value* value, const std::string& path) {
        const auto name = std::string(part.field.name);
        const auto* own = stated_in(value, name);
        const auto here = path.empty() ? name : path + "." + name;
        if (!acts_in(mode_, here)) return;
        if (part.type == Type::choice) return alternative(part, value, path);
        if (part.type == Type::record) {
            if (!part.optional || own) record(part, own, here);
            return;
        }
        if (auto stated = value_of(part, own); !stated.is_null()) add(part, std::move(stated), here);
    }

    /// The fields of the alternative that the object names.
    void alternative(const Layout& part, const json::Value* value, const std::string& path) {
        const auto* said = stated_in(value, part.field.name);
        const auto* name = said ? said->as<std::string>() : nullptr;
        for (const auto& one : part.parts)
            if (name && one.name == *name) record(one, value, path);
    }

    /// The value stated, or the default in the scene's units; null if there is none.
    json::Value value_of(const Layout& part, const json::Value* own) const {
        switch (part.type) {
        case Type::truth:
            return own ? *own : part.usual;
        case Type::text:
            if (part.field.choices.empty()) return {};
            return own ? *own : part.usual;
        case Type::integer:
        case Type::number:
            return own ? *own : usual_number(part);
        case Type::point:
            return point(part, own);
        default:
            return {}; // lists and maps are left to a text editor
        }
    }

    json::Value usual_number(const Layout& part) const {
        const auto* usual = part.usual.as<json::Number>();
        if (!usual) return {};
        if (part.type == Type::integer) return json::Value(*usual);
        return rounded(usual->value * units_.scale(part.field.unit));
    }

    json::Value point(const Layout& part, const json::Value* own) const {
        if (own) return *own;
        if (part.optional) return {};
        return json::Array(std::size_t(dimension_), json::Value(0));
    }

    static std::string_view name_of(Type type) {
        switch (type) {
        case Type::truth:
            return "truth";
        case Type::integer:
            return "integer";
        case Type::number:
            return "number";
        case Type::text:
            return "text";
        default:
            return "point";
        }
    }

    void add(const Layout& part, json::Value value, const std::string& path) {
        auto name = std::string(part.field.name);
        std::replace(name.begin(), name.end(), '_', ' ');
        json::Object parameter{{"path", path},
                               {"name", std::move(name)},
                               {"value", std::move(value)},
                               {"type", name_of(part.type)},
                               {"unit", unit_text(part, path, units_, mode_)}};
        const auto range = range_in_file(part.field, units_);
        if (std::isfinite(range.low)) parameter.push_back({"low", range.low});
        if (std::isfinite(range.high)) parameter.push_back({"high", range.high});
        if (!part.field.choices.empty())
            parameter.push_back({"choices", json::Array(part.field.choices.begin(), part.field.choices.end())});
        parameter.push_back({"help", part.field.help});
        found_.push_back(std::move(parameter));
    }
};

} // namespace

const Layout& section_layout(std::string_view name) {
    static const Layout scene = scene_layout();
    const auto found = std::find_if(scene.parts.begin(), scene.parts.end(),
                                    [&](const Layout& part) { return part.field.name == name; });
    assert(found != scene.parts.end());
    return *found;
}

bool acts_in(std::string_view mode, const std::string& path) {
    const auto known = of_any_figure(path);
    return std::none_of(parts_of_modes.begin(), parts_of_modes.end(),
                        [&](const OfMode& part) { return part.path == known && part.mode != mode; });
}

std::string unit_text(const Layout& field, const std::string& path, const Units& units, std::string_view mode) {
    for (const auto& one : measured_otherwise)
        if (one.path == path && (one.mode.empty() || one.mode == mode)) return std::string(one.unit);
    if (path == "world.damping") return units.text(unit::per_time);
    return units.text(field.field.unit);
}

const Layout& figure_layout() {
    return section_layout("figures").parts[0];
}

json::Array parameters_of(const Scene& scene, std::size_t max_figures) {
    const auto document = to_json(scene);
    const auto units = scene.measures();
    json::Array found;
    ParameterCollector collector(units, scene.dimension, scene.solver.mode, found);
    for (const auto* section : {"world", "solver"})
        collector.record(section_layout(section), stated_in(&document, section), section);
    const auto* own = stated_in(&document, "figures");
    if (const auto* figures = own ? own->as<json::Array>() : nullptr)
        for (std::size_t i = 0; i < std::min(figures->size(), max_figures); ++i)
            collector.record(figure_layout(), &(*figures)[i], "figures." + std::to_string(i));
    return found;
}

json::Array parameters_of(const Layout& prefab) {
    json::Array found;
    const Units metres;
    ParameterCollector(metres, 2, "physical", found).record(prefab, nullptr, "");
    return found;
}

} // namespace sinew

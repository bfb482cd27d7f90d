#include "apps/cli/kind_text.h"

#include <array>
#include <fmt/format.h>
#include <string_view>
#include <utility>
#include <vector>

namespace sinew::cli {
namespace {

/// Units of a measure by its power of length, 0 to 3. A multiplier times a gradient is a force; a compliance is a
/// measure by a multiplier.
struct MeasureUnits {
    std::string_view measure, multiplier, compliance;
};
constexpr std::array<MeasureUnits, 4> units_of_power = {{{"degrees in scenes, radians in programs", "N m", "rad/(N m)"},
                                                         {"m", "N", "m/N"},
                                                         {"m^2", "N/m", "m^3/N"},
                                                         {"m^3", "N/m^2", "m^5/N"}}};

std::string particles_of(const KindInfo& kind) {
    return fmt::format("{}{}{}", kind.min_arity, kind.any_arity ? " or more" : "",
                       kind.manual.particles.empty() ? "" : fmt::format(". {}", kind.manual.particles));
}

std::string dimensions_of(const KindInfo& kind) {
    const auto [lowest, highest] = kind.dimensions;
    return lowest == highest ? fmt::format("{}", lowest) : fmt::format("{} and {}", lowest, highest);
}

std::vector<std::pair<std::string_view, std::string>> facts_of(const KindInfo& kind) {
    const auto& units = units_of_power[std::size_t(kind.length_power)];
    std::vector<std::pair<std::string_view, std::string>> facts{{"particles", particles_of(kind)}};
    const auto add = [&](std::string_view name, std::string_view text) {
        if (!text.empty()) facts.emplace_back(name, text);
    };
    add("zero", kind.manual.zero);
    add("sign", kind.manual.sign);
    add("use", kind.manual.use);
    add("unit", units.measure);
    add("compliance", fmt::format("{}; 0 is rigid", units.compliance));
    add("multiplier", fmt::format("{}: `max_force`, `break_force` and the tension told are in it", units.multiplier));
    add("dimensions", dimensions_of(kind));
    return facts;
}

} // namespace

std::string kind_text(const KindInfo& kind) {
    std::string out = fmt::format("{}: {}\n", kind.name, kind.manual.about);
    if (!kind.manual.drawing.empty()) out += fmt::format("\n{}", kind.manual.drawing);
    out += "\n";
    for (const auto& [name, text] : facts_of(kind)) out += fmt::format("  {:<11} {}\n", name, text);
    if (!kind.manual.example.empty()) out += fmt::format("  {:<11} {}\n", "example", kind.manual.example);
    return out;
}

std::string kind_markdown(const KindInfo& kind) {
    std::string out = fmt::format("## `{}`\n\n{}\n\n", kind.name, kind.manual.about);
    if (!kind.manual.drawing.empty()) out += fmt::format("```\n{}```\n\n", kind.manual.drawing);
    for (const auto& [name, text] : facts_of(kind)) out += fmt::format("- **{}**: {}\n", name, text);
    if (!kind.manual.example.empty()) out += fmt::format("\n```\n{}\n```\n", kind.manual.example);
    return out;
}

} // namespace sinew::cli

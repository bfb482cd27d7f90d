#include "bench/cases.h"

#include "bench/simulation.h"

#include <charconv>
#include <cmath>

namespace sinew::bench {
namespace {

constexpr std::string_view direct_suffix = "-direct";

/// A whole number; empty for any other text.
std::optional<double> whole(std::string_view text) {
    double number = 0;
    const auto* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || stop != end || number != std::floor(number)) return std::nullopt;
    return number;
}

} // namespace

std::span<const CaseFamily> families() {
#define SINEW_CALL(name) family::name(),
    static const std::vector<CaseFamily> all{SINEW_FAMILIES(SINEW_CALL)};
#undef SINEW_CALL
    return all;
}

std::optional<Case> find_case(std::string_view name) {
    auto stem = name;
    const bool direct = stem.ends_with(direct_suffix);
    if (direct) stem.remove_suffix(direct_suffix.size());
    const auto dash = stem.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    const auto size = whole(stem.substr(dash + 1));
    if (!size) return std::nullopt;
    for (const auto& family : families())
        if (family.name == stem.substr(0, dash) && *size >= 2 && *size <= family.max && (family.has_direct || !direct))
            return Case{std::string(name), &family, int(*size), direct};
    return std::nullopt;
}

std::vector<Case> all_cases() {
    std::vector<Case> all;
    for (const auto& family : families())
        for (const auto& size : family.sizes) {
            const auto name = std::string(family.name) + "-" + size;
            all.push_back(*find_case(name));
            if (family.has_direct) all.push_back(*find_case(name + std::string(direct_suffix)));
        }
    return all;
}

template <class Real> World<3, Real> world_of(const Case& chosen) {
    World<3, Real> world;
    world.forces.push_back(Gravity<3, Real>{{{0, Real(-9.81), 0}}});
    chosen.family->build(world, chosen.size);
    world.settings.substeps = chosen.direct ? 0 : Effort{}.substeps;
    world.settings.iterations = Effort{}.iterations;
    for (auto& figure : world.figures) figure.direct = chosen.direct ? Direct::automatic : Direct::off;
    return world;
}

template World<3, float> world_of(const Case&);
template World<3, double> world_of(const Case&);

} // namespace sinew::bench

#include "sinew/prefab/problem.h"

#include "sinew/math/format.h"
#include "sinew/math/scalar.h"
#include "sinew/math/trig.h"

#include <algorithm>

namespace sinew::detail {

std::optional<std::string> problem_of(const Field& field, double value) {
    if (value >= field.low && value <= field.high) return std::nullopt;
    const bool has_low = is_finite(field.low), has_high = is_finite(field.high);
    if (!has_low && !has_high)
        return is_finite(value) ? std::nullopt : std::optional(format_text("{} is not finite", field.name));
    const auto range = has_low && has_high ? format_text("from {:6} to {:6}", field.low, field.high)
                       : has_low           ? format_text("at least {:6}", field.low)
                                           : format_text("at most {:6}", field.high);
    return format_text("{} is {}{}, found {:6}", field.name, range, field.unit.angle ? " radians" : "", value);
}

std::optional<std::string> problem_of(const Field& field, std::string_view word) {
    if (field.choices.empty() || std::ranges::find(field.choices, word) != field.choices.end()) return std::nullopt;
    std::string words;
    for (const auto choice : field.choices) words += format_text("{}{}", words.empty() ? "" : ", ", choice);
    return format_text("{} is one of {}, found \"{}\"", field.name, words, word);
}

std::optional<std::string> problem_of_sizes(const Sizes& sizes) {
    if (sizes.particles <= limit::rows && sizes.constraints <= limit::rows) return std::nullopt;
    return format_text("{} particles and {} constraints are more than the {} of a world", sizes.particles,
                       sizes.constraints, limit::rows);
}

std::optional<std::string> problem_of_mass(double mass, std::size_t particles) {
    constexpr double lightest = 1 / limit::mass<double>;
    if (mass >= lightest * double(particles)) return std::nullopt;
    return format_text("a mass of {} is too little for {} particles: each weighs {} at least", mass, particles,
                       lightest);
}

} // namespace sinew::detail

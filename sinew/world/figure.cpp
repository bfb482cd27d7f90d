#include "sinew/world/figure.h"

#include <charconv>

namespace sinew {
namespace {

/// Removes "_12" from the front of a text. Only the shortest spelling of a number counts, so names are unique.
std::optional<std::size_t> take_number(std::string_view& text) {
    if (text.size() < 2 || text[0] != '_') return std::nullopt;
    const char* const begin = text.data() + 1;
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
    if (error != std::errc{} || (*begin == '0' && end != begin + 1)) return std::nullopt;
    text.remove_prefix(std::size_t(end - text.data()));
    return number;
}

std::optional<std::size_t> number_called(std::string_view name, const Numbered& rule) {
    if (!name.starts_with(rule.stem)) return std::nullopt;
    name.remove_prefix(rule.stem.size());
    auto number = take_number(name);
    if (number && rule.columns > 0) {
        const auto row = take_number(name);
        const bool inside = row && *number < rule.columns && *row < rule.count / rule.columns;
        number = inside ? std::optional(*row * rule.columns + *number) : std::nullopt;
    }
    if (!number || !name.empty() || *number >= rule.count) return std::nullopt;
    return rule.first + *number;
}

} // namespace

std::optional<std::size_t> number_called(std::string_view name, std::span<const Numbered> numbered) {
    for (const auto& rule : numbered)
        if (const auto number = number_called(name, rule)) return number;
    return std::nullopt;
}

std::string name_of(std::size_t number, std::span<const Numbered> numbered) {
    for (const auto& rule : numbered) {
        if (number < rule.first || number - rule.first >= rule.count) continue;
        const auto n = number - rule.first;
        if (rule.columns == 0) return rule.stem + "_" + std::to_string(n);
        return rule.stem + "_" + std::to_string(n % rule.columns) + "_" + std::to_string(n / rule.columns);
    }
    return {};
}

} // namespace sinew

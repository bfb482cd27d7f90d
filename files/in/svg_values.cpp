#include "files/in/svg_values.h"

#include "sinew/math/color.h"
#include "sinew/math/decimal.h"

#include "files/in/hex_color.h"

#include <algorithm>
#include <array>

namespace sinew::files::svg_value {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

/// Length of the number in front of a text, as CSS writes it: -1.5e3, .5; 0 for none.
std::size_t end_of_number(std::string_view text) {
    const auto digits_from = [&](std::size_t begin) {
        return std::min(text.find_first_not_of("0123456789", begin), text.size()) - begin;
    };
    std::size_t at = text.starts_with('+') || text.starts_with('-') ? 1 : 0;
    auto digits = digits_from(at);
    at += digits;
    if (at < text.size() && text[at] == '.') {
        const auto behind = digits_from(at + 1);
        at += behind > 0 || digits > 0 ? 1 + behind : 0;
        digits += behind;
    }
    if (digits == 0) return 0;
    if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) { // em and ex are units
        const bool has_sign = at + 1 < text.size() && (text[at + 1] == '+' || text[at + 1] == '-');
        const auto power = at + (has_sign ? 2 : 1);
        if (digits_from(power) > 0 && power < text.size()) at = power + digits_from(power);
    }
    return at;
}

/// Takes a number from the front of a text.
std::optional<double> take_number(std::string_view& text) {
    constexpr double largest = 1e9;
    const auto end = end_of_number(text);
    if (end == 0) return std::nullopt;
    const double number = decimal::parse(text.substr(0, end));
    if (!(std::abs(number) <= largest)) return std::nullopt;
    text.remove_prefix(end);
    return number;
}

std::string_view skipped(std::string_view text) {
    while (!text.empty() && (is_space(text.front()) || text.front() == ',')) text.remove_prefix(1);
    return text;
}

struct LengthUnit {
    std::string_view name;
    double pixels;
};
// CSS Values 3, 6.2: an inch has 96 pixels. em and ex are those of a font of 16 pixels.
constexpr std::array<LengthUnit, 11> length_units = {{{"", 1},
                                                      {"px", 1},
                                                      {"in", 96},
                                                      {"cm", 96 / 2.54},
                                                      {"mm", 96 / 25.4},
                                                      {"Q", 96 / 101.6},
                                                      {"pt", 96.0 / 72},
                                                      {"pc", 16},
                                                      {"em", 16},
                                                      {"rem", 16},
                                                      {"ex", 8}}};

std::optional<Affine> one_transform(std::string_view name, const std::vector<double>& n) {
    const auto has = [&](std::size_t least, std::size_t most) { return n.size() >= least && n.size() <= most; };
    if (name == "matrix" && has(6, 6)) return Affine{{{n[0], n[1]}}, {{n[2], n[3]}}, {{n[4], n[5]}}};
    if (name == "translate" && has(1, 2)) return moved_by({{n[0], n.size() > 1 ? n[1] : 0}});
    if (name == "scale" && has(1, 2)) return scaled_by(n[0], n.back());
    if (name == "rotate" && n.size() == 1) return turned_by(n[0]);
    if (name == "rotate" && n.size() == 3)
        return moved_by({{n[1], n[2]}}) * turned_by(n[0]) * moved_by({{-n[1], -n[2]}});
    const double slope = n.size() == 1 ? std::tan(n[0] * (pi<double> / 180)) : 0;
    if (name == "skewX" && has(1, 1)) return Affine{{{1, 0}}, {{slope, 1}}, {}};
    if (name == "skewY" && has(1, 1)) return Affine{{{1, slope}}, {{0, 1}}, {}};
    return std::nullopt;
}

/// Red, green and blue of hsl(), 0 to 255 (CSS Color 4, 7.1): hue in degrees, saturation and lightness from 0 to 1.
std::array<double, 3> from_hsl(double hue, double saturation, double lightness) {
    const double range = saturation * std::min(lightness, 1 - lightness);
    const auto channel = [&](double shift) {
        const double turn = shift + hue / 30, sector = turn - 12 * std::floor(turn / 12);
        return 255 * (lightness - range * std::clamp(std::min(sector - 3, 9 - sector), -1.0, 1.0));
    };
    return {channel(0), channel(8), channel(4)};
}

/// Red, green, blue and alpha of rgb(), rgba(), hsl() and hsla(), 0 to 255.
std::optional<std::array<double, 4>> channels(std::string_view text) {
    const bool is_hsl = text.starts_with("hsl");
    const auto open = text.find('('), close = text.find(')');
    if (open == text.npos || close == text.npos || close < open || !(is_hsl || text.starts_with("rgb")))
        return std::nullopt;
    std::array<double, 4> result{0, 0, 0, 255};
    auto rest = skipped(text.substr(open + 1, close - open - 1));
    for (std::size_t i = 0; i < 4 && !rest.empty(); ++i) {
        const auto number = take_number(rest);
        if (!number) return std::nullopt;
        const bool is_share = rest.starts_with('%');
        if (is_share) rest.remove_prefix(1);
        if (is_hsl && i == 0 && rest.starts_with("deg")) rest.remove_prefix(3);
        const bool is_percent = is_share || (is_hsl && (i == 1 || i == 2));
        result[i] = is_percent ? *number * 2.55 : i == 3 ? *number * 255 : *number;
        rest = skipped(rest);
        if (rest.starts_with('/')) rest = skipped(rest.substr(1));
    }
    if (!is_hsl) return result;
    const auto [red, green, blue] = from_hsl(result[0], result[1] / 255, result[2] / 255);
    return std::array{red, green, blue, result[3]};
}

std::string hex_of(const Color& color, double opacity) {
    const auto byte = [](double share) { return int(std::clamp(share, 0.0, 1.0) * 255 + 0.5); };
    const int alpha = byte(double(color.alpha) * opacity);
    const int red = byte(double(color.red)), green = byte(double(color.green)), blue = byte(double(color.blue));
    return alpha < 255 ? hex_color({red, green, blue, alpha}) : hex_color({red, green, blue});
}

} // namespace

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

std::optional<std::vector<double>> numbers(std::string_view text) {
    std::vector<double> result;
    for (text = skipped(text); !text.empty(); text = skipped(text)) {
        const auto number = take_number(text);
        if (!number) return std::nullopt;
        result.push_back(*number);
    }
    return result;
}

std::optional<double> length(std::string_view text, double whole) {
    text = trimmed(text);
    const auto number = take_number(text);
    if (!number) return std::nullopt;
    if (text == "%") return *number / 100 * whole;
    const auto unit = std::ranges::find(length_units, text, &LengthUnit::name);
    if (unit == length_units.end()) return std::nullopt;
    return *number * unit->pixels;
}

std::optional<Affine> transform(std::string_view text) {
    Affine all;
    for (text = skipped(text); !text.empty(); text = skipped(text)) {
        const auto open = text.find('('), close = text.find(')');
        if (open == text.npos || close == text.npos || close < open) return std::nullopt;
        const auto values = numbers(text.substr(open + 1, close - open - 1));
        const auto one = values ? one_transform(trimmed(text.substr(0, open)), *values) : std::nullopt;
        if (!one) return std::nullopt;
        all = all * *one;
        text.remove_prefix(close + 1);
    }
    return all;
}

std::optional<std::string> color(std::string_view text, double opacity) {
    text = trimmed(text);
    if (text == "none" || text == "transparent") return "none";
    if (const auto rgb = channels(text)) {
        const auto share = [&](std::size_t i) { return float((*rgb)[i] / 255); };
        return hex_of({share(0), share(1), share(2), share(3)}, opacity);
    }
    std::string word(text);
    std::ranges::transform(word, word.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
    const auto parsed = parse_color(word);
    return parsed ? std::optional(hex_of(*parsed, opacity)) : std::nullopt;
}

} // namespace sinew::files::svg_value

#include "sinew/math/color.h"

#include <array>
#include <utility>

namespace sinew {
namespace {

/// The sixteen of HTML 4 and a few that figures like to wear.
constexpr std::array<std::pair<std::string_view, std::string_view>, 24> names = {{
    {"black", "#000000"},  {"silver", "#c0c0c0"}, {"gray", "#808080"},    {"white", "#ffffff"}, {"maroon", "#800000"},
    {"red", "#ff0000"},    {"purple", "#800080"}, {"fuchsia", "#ff00ff"}, {"green", "#008000"}, {"lime", "#00ff00"},
    {"olive", "#808000"},  {"yellow", "#ffff00"}, {"navy", "#000080"},    {"blue", "#0000ff"},  {"teal", "#008080"},
    {"aqua", "#00ffff"},   {"orange", "#ffa500"}, {"brown", "#8b5a2b"},   {"pink", "#ffc0cb"},  {"gold", "#ffd700"},
    {"tomato", "#ff6347"}, {"coral", "#ff7f50"},  {"skyblue", "#87ceeb"}, {"ink", "#2b2d42"},
}};

constexpr int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::optional<Color> parse_hex(std::string_view digits) {
    const bool brief = digits.size() == 3;
    if (!brief && digits.size() != 6 && digits.size() != 8) return std::nullopt;
    std::array<float, 4> channel = {0, 0, 0, 1};
    const std::size_t width = brief ? 1 : 2;
    for (std::size_t i = 0; i < digits.size() / width; ++i) {
        const int high = digit(digits[i * width]), low = digit(digits[i * width + width - 1]);
        if (high < 0 || low < 0) return std::nullopt;
        channel[i] = float(16 * high + low) / 255.0F;
    }
    return Color{channel[0], channel[1], channel[2], channel[3]};
}

} // namespace

std::optional<Color> parse_color(std::string_view text) {
    if (text == "none") return Color{0, 0, 0, 0};
    if (text.starts_with('#')) return parse_hex(text.substr(1));
    for (const auto& [name, hex] : names)
        if (name == text) return parse_hex(hex.substr(1));
    return std::nullopt;
}

} // namespace sinew

#include "sinew/math/color.h"

#include "sinew/math/color_names.h"

#include <algorithm>
#include <array>

namespace sinew {
namespace {

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

constexpr Color from_rgb(std::uint32_t rgb) {
    const auto channel = [rgb](int shift) { return float(rgb >> shift & 0xff) / 255.0F; };
    return {channel(16), channel(8), channel(0), 1};
}

} // namespace

std::optional<Color> parse_color(std::string_view text) {
    if (text == "none") return Color{0, 0, 0, 0};
    if (text.starts_with('#')) return parse_hex(text.substr(1));
    const auto found = std::ranges::lower_bound(css_colors, text, {}, &NamedColor::name);
    if (found == css_colors.end() || found->name != text) return std::nullopt;
    return from_rgb(found->rgb);
}

std::string hex_of(const Color& color) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const float channel : {color.red, color.green, color.blue}) {
        const auto byte = std::size_t(std::clamp(channel, 0.0F, 1.0F) * 255 + 0.5F);
        text += {digits[byte / 16], digits[byte % 16]};
    }
    return text;
}

} // namespace sinew

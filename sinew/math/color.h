#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sinew {

/// A colour in sRGB with straight (not premultiplied) alpha, each channel in 0..1.
struct Color {
    float red = 0, green = 0, blue = 0, alpha = 1;
    friend constexpr bool operator==(const Color&, const Color&) = default;
};

/// Parses #rgb, #rrggbb, #rrggbbaa, "none" (fully transparent) or a CSS colour name (color_names.h). Returns nothing
/// for any other text.
std::optional<Color> parse_color(std::string_view text);
/// #rrggbb, channels clamped to [0, 1]; without alpha.
std::string hex_of(const Color& color);

/// Linear interpolation a + (b - a) t of each channel.
constexpr Color mix(const Color& a, const Color& b, float t) {
    return {a.red + (b.red - a.red) * t, a.green + (b.green - a.green) * t, a.blue + (b.blue - a.blue) * t,
            a.alpha + (b.alpha - a.alpha) * t};
}

} // namespace sinew

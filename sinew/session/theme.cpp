#include "sinew/session/theme.h"

#include "sinew/scene/look_section.h"

namespace sinew {
namespace {

constexpr Color rgb(unsigned hex) {
    return {float(hex >> 16U & 255U) / 255, float(hex >> 8U & 255U) / 255, float(hex & 255U) / 255, 1};
}

/// Warm paper and strong, slightly muted inks; neighbours in the palette differ in hue and in lightness.
constexpr Theme light = {
    .background = rgb(0xf6f1e7),
    .ground = rgb(0xd9cfbb),
    .wall = rgb(0xb8ab92),
    .shadow = rgb(0xe6decd),
    .floor_shadow = rgb(0xbdb19a),
    .ink = rgb(0x2b2d42),
    .pen = rgb(0x2b2d42),
    .outline_shade = 0.7F,
    .palette = {rgb(0xe4572e), rgb(0x1f8a8a), rgb(0x3f6fb5), rgb(0xe9a820), rgb(0x7d5ba6), rgb(0x5c8d4e)},
    .materials = {{{"head", rgb(0xf2b58c)},
                   {"face", rgb(0x2b2d42)},
                   {"arm", rgb(0xf2b58c)},
                   {"hand", rgb(0xf2b58c)},
                   {"leg", rgb(0x35507d)},
                   {"belt", rgb(0x35507d)},
                   {"foot", rgb(0x3a3636)},
                   {"link", rgb(0x7b8794)},
                   {"rope", rgb(0xc0935a)}}},
};

constexpr Theme dark = {
    .background = rgb(0x1b1e27),
    .ground = rgb(0x2b303d),
    .wall = rgb(0x4a5163),
    .shadow = rgb(0x11131a),
    .floor_shadow = rgb(0x191c25),
    .ink = rgb(0x08090c),
    .pen = rgb(0xe6e1d6),
    .outline_shade = 0.65F,
    .palette = {rgb(0xff7a52), rgb(0x43c6b9), rgb(0x74a7ff), rgb(0xffcb52), rgb(0xb993e6), rgb(0x93c47d)},
    .materials = {{{"head", rgb(0xf6c29c)},
                   {"face", rgb(0x2b2d42)},
                   {"arm", rgb(0xf6c29c)},
                   {"hand", rgb(0xf6c29c)},
                   {"leg", rgb(0x5f7fb8)},
                   {"belt", rgb(0x5f7fb8)},
                   {"foot", rgb(0xd8d2c8)},
                   {"link", rgb(0xa9b4c4)},
                   {"rope", rgb(0xd8ae74)}}},
};

} // namespace

std::optional<Color> color_in(const Theme& theme, std::string_view text) {
    if (text == theme_colors[0]) return theme.pen;
    if (text == theme_colors[1]) return theme.background;
    return parse_color(text);
}

const Theme& theme_called(std::string_view name) {
    return name == "dark" ? dark : light;
}

} // namespace sinew

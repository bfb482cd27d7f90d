#include "sinew/session/theme.h"

namespace sinew {
namespace {

constexpr Color rgb(unsigned hex) {
    return {float(hex >> 16U & 255U) / 255, float(hex >> 8U & 255U) / 255, float(hex & 255U) / 255, 1};
}

/// Warm paper and strong, slightly muted inks; neighbours in the palette differ in hue and in lightness.
constexpr Theme light = {
    .background = rgb(0xf6f3ec),
    .wall = rgb(0xb9b2a3),
    .ink = rgb(0x2b2d42),
    .outline_shade = 0.75F,
    .palette = {rgb(0xe4572e), rgb(0x1f8a8a), rgb(0x3f6fb5), rgb(0xe9a820), rgb(0x7d5ba6), rgb(0x5c8d4e)},
};

constexpr Theme dark = {
    .background = rgb(0x16181d),
    .wall = rgb(0x4a4f5c),
    .ink = rgb(0x08090b),
    .outline_shade = 0.6F,
    .palette = {rgb(0xff7a52), rgb(0x43c6b9), rgb(0x74a7ff), rgb(0xffcb52), rgb(0xb993e6), rgb(0x93c47d)},
};

} // namespace

const Theme& theme_called(std::string_view name) {
    return name == "dark" ? dark : light;
}

} // namespace sinew

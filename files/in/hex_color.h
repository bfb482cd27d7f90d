#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace sinew::files {

/// Channels from 0 to 255 as a colour of a scene: "#ffaa00".
inline std::string hex_color(std::initializer_list<int> channels) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text = "#";
    for (const int channel : channels)
        text += digits[std::size_t(channel) >> 4U & 15U], text += digits[std::size_t(channel) & 15U];
    return text;
}

} // namespace sinew::files

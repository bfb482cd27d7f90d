#pragma once

#include "sinew/math/format.h"

#include <concepts>
#include <string>
#include <string_view>

/// Text helpers for messages.
namespace sinew {

namespace detail {
inline void append(std::string& out, std::string_view text) {
    out += text;
}
template <std::integral I> void append(std::string& out, I number) {
    out += std::to_string(number);
}
} // namespace detail

/// Concatenates strings and integers.
template <class... Part> std::string concat(const Part&... part) {
    std::string out;
    (detail::append(out, part), ...);
    return out;
}

/// The text made safe for a terminal: control characters are escaped and long texts cut.
std::string printable(std::string_view text, std::size_t max_characters = 60);
/// The printable text in double quotes.
std::string in_quotes(std::string_view text, std::size_t max_characters = 60);

} // namespace sinew

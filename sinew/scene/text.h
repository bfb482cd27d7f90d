#pragma once

#include <concepts>
#include <string>
#include <string_view>

/// Text for messages.
namespace sinew {

namespace detail {
inline void append(std::string& out, std::string_view text) {
    out += text;
}
template <std::integral I> void append(std::string& out, I number) {
    out += std::to_string(number);
}
} // namespace detail

/// Texts and whole numbers, one after the other.
template <class... Part> std::string concat(const Part&... part) {
    std::string out;
    (detail::append(out, part), ...);
    return out;
}

/// The text fit for a message: nothing in it controls a terminal, and a long one is cut.
std::string printable(std::string_view text, std::size_t most_characters = 60);
/// The same in double quotes.
std::string in_quotes(std::string_view text, std::size_t most_characters = 60);

/// The shortest text that reads back as the same number.
std::string number_text(double number);

} // namespace sinew

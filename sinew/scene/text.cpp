#include "sinew/scene/text.h"

#include "sinew/scene/utf8.h"

#include <array>
#include <charconv>

namespace sinew {

std::string in_quotes(std::string_view text, std::size_t most_characters) {
    return concat("\"", printable(text, most_characters), "\"");
}

std::string printable(std::string_view text, std::size_t most_characters) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string out;
    for (std::size_t at = 0, count = 0; at < text.size(); ++count) {
        if (count == most_characters) {
            out += "...";
            break;
        }
        const auto character = utf8::decode(text, at);
        if (!character.valid || utf8::is_control(character.code)) {
            out += "\\u";
            for (int shift = 12; shift >= 0; shift -= 4) out += digits[(character.code >> shift) & 0xFu];
        } else {
            out += text.substr(at, character.bytes);
        }
        at += character.bytes;
    }
    return out;
}

std::string number_text(double number) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    std::string text(digits.data(), end);
    const auto exponent = text.find('e');
    if (exponent == std::string::npos) return text;
    // std::to_chars writes 1e+06 and 1e-06; common notation is 1e6 and 1e-6.
    const bool negative = text[exponent + 1] == '-';
    const auto value = text.substr(text.find_first_not_of("+-0", exponent + 1));
    return concat(text.substr(0, exponent), negative ? "e-" : "e", value);
}

} // namespace sinew

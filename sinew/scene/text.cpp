#include "sinew/scene/text.h"

#include "sinew/scene/utf8.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

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

namespace {

#if defined(__wasm__)
/// Shortest text that parses back, as std::to_chars writes it; libc++'s own brings tables of 110 KB.
std::string shortest(double number) {
    if (!std::isfinite(number)) return std::isnan(number) ? "nan" : number < 0 ? "-inf" : "inf";
    std::array<char, 40> text{};
    for (int digits = 0; digits < 17; ++digits) {
        std::snprintf(text.data(), text.size(), "%.*e", digits, number);
        if (std::strtod(text.data(), nullptr) == number) break;
    }
    const std::string scientific = text.data();
    const auto e = scientific.find('e');
    const int exponent = std::atoi(scientific.c_str() + e + 1);
    const int behind_point = std::max(0, int(e) - int(scientific.find_first_of("0123456789")) - 2);
    const int decimals = std::max(0, behind_point - exponent);
    std::array<char, 400> fixed{};
    const int length = std::snprintf(fixed.data(), fixed.size(), "%.*f", decimals, number);
    return std::size_t(length) <= scientific.size() ? fixed.data() : scientific;
}
#else
std::string shortest(double number) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr};
}
#endif

} // namespace

std::string number_text(double number) {
    const auto text = shortest(number);
    const auto exponent = text.find('e');
    if (exponent == std::string::npos) return text;
    // std::to_chars writes 1e+06 and 1e-06; common notation is 1e6 and 1e-6.
    const bool negative = text[exponent + 1] == '-';
    const auto value = text.substr(text.find_first_not_of("+-0", exponent + 1));
    return concat(text.substr(0, exponent), negative ? "e-" : "e", value);
}

} // namespace sinew

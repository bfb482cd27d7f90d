#include "sinew/scene/text.h"

#include "sinew/math/decimal.h"
#include "sinew/scene/utf8.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace sinew {

std::string in_quotes(std::string_view text, std::size_t max_characters) {
    return concat("\"", printable(text, max_characters), "\"");
}

std::string printable(std::string_view text, std::size_t max_characters) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string out;
    for (std::size_t at = 0, count = 0; at < text.size(); ++count) {
        if (count == max_characters) {
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

} // namespace sinew

#include "files/in/encoded.h"

#include <cstdint>

namespace sinew::files {

std::optional<std::string> from_base64(std::string_view text) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t group = 0;
    int bits = 0;
    while (!text.empty() && (text.back() == '=' || text.back() == '\n' || text.back() == ' ')) text.remove_suffix(1);
    for (const char c : text) {
        if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
        const auto digit = digits.find(c);
        if (digit == digits.npos) return std::nullopt;
        group = group << 6U | std::uint32_t(digit);
        if ((bits += 6) < 8) continue;
        bits -= 8;
        bytes += char(group >> unsigned(bits) & 255U);
    }
    return bytes;
}

} // namespace sinew::files

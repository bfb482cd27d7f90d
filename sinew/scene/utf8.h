#pragma once

#include <cstddef>
#include <string_view>

namespace sinew::utf8 {

struct Decoded {
    char32_t code = 0;
    std::size_t bytes = 1; ///< length in bytes; 1 for a byte that is not part of a character
    bool valid = true;
};

/// Decodes the character at `at`, which must be inside the text (RFC 3629: no overlong forms, no surrogates).
constexpr Decoded decode(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(at);
    if (first < 0x80) return {char32_t(first), 1, true};

    const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    constexpr Decoded broken{0xFFFD, 1, false};
    if (first < 0xC2 || first > 0xF4 || at + bytes > text.size()) return broken;

    char32_t code = first & (0x7Fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(at + i) & 0xC0u) != 0x80u) return broken;
        code = code << 6 | (byte(at + i) & 0x3Fu);
    }
    const bool overlong = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
    const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (overlong || surrogate || code > 0x10FFFF) return broken;
    return {code, bytes, true};
}

/// Offset of the first byte that belongs to no character, or the size of the text.
constexpr std::size_t first_broken(std::string_view text) {
    std::size_t at = 0;
    for (Decoded character; at < text.size(); at += character.bytes) {
        character = decode(text, at);
        if (!character.valid) return at;
    }
    return at;
}

/// True for continuation bytes 10xxxxxx.
constexpr bool continues(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0u) == 0x80u;
}

/// True for characters that move the cursor, ring, recolour or reorder a terminal (controls, bidirectional overrides).
constexpr bool is_control(char32_t code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x2028 && code <= 0x202E) ||
           (code >= 0x2066 && code <= 0x2069) || code == 0x200E || code == 0x200F || code == 0xFEFF;
}

/// Columns of a terminal the character takes: 0, 1 or 2 (the common part of Unicode's East Asian Width and marks).
constexpr int columns(char32_t code) {
    const bool mark = (code >= 0x300 && code <= 0x36F) || (code >= 0x200B && code <= 0x200D) ||
                      (code >= 0x20D0 && code <= 0x20FF) || (code >= 0xFE00 && code <= 0xFE0F);
    if (mark) return 0;
    const bool wide = (code >= 0x1100 && code <= 0x115F) || (code >= 0x2E80 && code <= 0x303E) ||
                      (code >= 0x3041 && code <= 0xA4CF) || (code >= 0xAC00 && code <= 0xD7A3) ||
                      (code >= 0xF900 && code <= 0xFAFF) || (code >= 0xFE30 && code <= 0xFE6F) ||
                      (code >= 0xFF00 && code <= 0xFF60) || (code >= 0xFFE0 && code <= 0xFFE6) ||
                      (code >= 0x1F300 && code <= 0x1F64F) || (code >= 0x1F900 && code <= 0x1F9FF) ||
                      (code >= 0x20000 && code <= 0x3FFFD);
    return wide ? 2 : 1;
}

} // namespace sinew::utf8

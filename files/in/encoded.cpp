#include "files/in/encoded.h"

#include <cstdint>
#include <zlib.h>

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

std::optional<std::string> inflated(std::string_view bytes, std::size_t max) {
    z_stream stream{};
    constexpr int either_header = 15 + 32; // window bits; zlib or gzip
    if (inflateInit2(&stream, either_header) != Z_OK) return std::nullopt;
    std::string result;
    std::string input(bytes); // zlib's pointer is not const
    stream.next_in = reinterpret_cast<Bytef*>(input.data());
    stream.avail_in = uInt(input.size());
    int state = Z_OK;
    while (state == Z_OK && result.size() <= max) {
        char block[16384];
        stream.next_out = reinterpret_cast<Bytef*>(block);
        stream.avail_out = sizeof block;
        state = inflate(&stream, Z_NO_FLUSH);
        result.append(block, sizeof block - stream.avail_out);
    }
    inflateEnd(&stream);
    if (state != Z_STREAM_END || result.size() > max) return std::nullopt;
    return result;
}

} // namespace sinew::files

#include "files/out/stored_png.h"

#include "files/out/bytes.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace sinew::files {
namespace {

/// Remainders of bytes by the polynomial of CRC-32, lowest bit first (PNG, annex D).
constexpr auto remainders = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        auto rest = byte;
        for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1U) ^ ((rest & 1U) != 0 ? 0xEDB88320U : 0U);
        table[byte] = rest;
    }
    return table;
}();

std::uint32_t crc32(std::string_view bytes) {
    auto rest = ~std::uint32_t(0);
    for (const char c : bytes) rest = (rest >> 8U) ^ remainders[(rest ^ static_cast<unsigned char>(c)) & 255U];
    return ~rest;
}

std::uint32_t adler32(std::string_view bytes) {
    constexpr std::uint32_t modulus = 65521;
    std::uint32_t sum = 1, sums = 0;
    for (const char c : bytes) {
        sum = (sum + static_cast<unsigned char>(c)) % modulus;
        sums = (sums + sum) % modulus;
    }
    return sums << 16U | sum;
}

void put_chunk(std::string& file, std::string_view type, std::string_view data) {
    put_big(file, std::uint32_t(data.size()));
    const auto begin = file.size();
    file.append(type).append(data);
    put_big(file, crc32(std::string_view(file).substr(begin)));
}

/// A zlib stream of stored blocks (RFC 1950, RFC 1951).
std::string stored(std::string_view data) {
    constexpr std::size_t longest = 65535; // bytes of a block
    std::string stream = "\x78\x01";
    for (std::size_t begin = 0; begin < data.size(); begin += longest) {
        const auto block = data.substr(begin, longest);
        const bool is_last = begin + block.size() == data.size();
        const auto size = std::uint32_t(block.size());
        stream += char(is_last);
        put_little(stream, size | (~size << 16U)); // and its complement
        stream += block;
    }
    put_big(stream, adler32(data));
    return stream;
}

/// A channel without its opacity.
char straight(std::uint32_t channel, std::uint32_t alpha) {
    return char(alpha == 0 ? 0 : std::min((channel * 255 + alpha / 2) / alpha, std::uint32_t(255)));
}

/// Rows of red, green, blue and opacity, each after the number of its filter: none.
std::string rows_of(const Image& image) {
    std::string rows;
    rows.reserve(image.pixels.size() * 4 + std::size_t(image.height));
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        if (i % std::size_t(image.width) == 0) rows += '\0';
        const auto pixel = image.pixels[i], alpha = pixel >> 24U;
        for (const auto shift : {16U, 8U, 0U}) rows += straight(pixel >> shift & 255U, alpha);
        rows += char(alpha);
    }
    return rows;
}

} // namespace

std::string stored_png(const Image& image) {
    std::string file("\x89PNG\r\n\x1a\n"), header;
    put_big(header, std::uint32_t(image.width));
    put_big(header, std::uint32_t(image.height));
    constexpr std::string_view eight_bits_with_alpha("\x08\x06\0\0\0", 5);
    header += eight_bits_with_alpha;
    put_chunk(file, "IHDR", header);
    put_chunk(file, "IDAT", stored(rows_of(image)));
    put_chunk(file, "IEND", {});
    return file;
}

} // namespace sinew::files

#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace sinew::files {

namespace detail {
/// Remainders of bytes by the polynomial of CRC-32, lowest bit first (PNG, annex D).
inline constexpr auto remainders = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
        auto rest = byte;
        for (int bit = 0; bit < 8; ++bit) rest = (rest >> 1U) ^ ((rest & 1U) != 0 ? 0xEDB88320U : 0U);
        table[byte] = rest;
    }
    return table;
}();
} // namespace detail

/// Checksum of a chunk of PNG and of a stream of gzip.
inline std::uint32_t crc32(std::string_view bytes) {
    auto rest = ~std::uint32_t(0);
    for (const char c : bytes) rest = (rest >> 8U) ^ detail::remainders[(rest ^ static_cast<unsigned char>(c)) & 255U];
    return ~rest;
}

/// Checksum of a stream of zlib (RFC 1950).
inline std::uint32_t adler32(std::string_view bytes) {
    constexpr std::uint32_t modulus = 65521;
    constexpr std::size_t safe = 5552; // bytes before a sum may pass 32 bits
    std::uint32_t sum = 1, sums = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        sum += static_cast<unsigned char>(bytes[i]);
        sums += sum;
        if (i % safe == safe - 1) sum %= modulus, sums %= modulus;
    }
    return sums % modulus << 16U | sum % modulus;
}

} // namespace sinew::files

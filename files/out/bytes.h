#pragma once

#include <bit>
#include <cstdint>
#include <string>

/// Binary numbers at the end of a file's bytes, with the lowest byte first, or the highest.
namespace sinew::files {

inline void put_little(std::string& bytes, std::uint32_t number) {
    for (int shift = 0; shift < 32; shift += 8) bytes += char(number >> shift & 255);
}
inline void put_little(std::string& bytes, float number) {
    put_little(bytes, std::bit_cast<std::uint32_t>(number));
}
inline void put_big(std::string& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += char(number >> shift & 255);
}
inline void put_big(std::string& bytes, float number) {
    put_big(bytes, std::bit_cast<std::uint32_t>(number));
}

} // namespace sinew::files

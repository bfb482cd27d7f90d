#pragma once

#include <array>
#include <cstdint>

namespace sinew::files {

/// Base and number of further bits of the length or the distance of a copy (RFC 1951, 3.2.5).
struct CopyExtent {
    std::uint16_t base;
    std::uint8_t bits;
};

namespace detail {
template <std::size_t count> constexpr std::array<CopyExtent, count> copy_extents(unsigned first, unsigned run) {
    std::array<CopyExtent, count> table{};
    unsigned base = first;
    for (unsigned i = 0; i < count; ++i) {
        const unsigned bits = i < 2 * run ? 0 : i / run - 1;
        table[i] = {std::uint16_t(base), std::uint8_t(bits)};
        base += 1U << bits;
    }
    return table;
}
} // namespace detail

inline constexpr unsigned longest_copy = 258; ///< bytes
inline constexpr auto copy_lengths = [] {
    auto table = detail::copy_extents<29>(3, 4);
    table[28] = {longest_copy, 0};
    return table;
}();
inline constexpr auto copy_distances = detail::copy_extents<30>(1, 2);

} // namespace sinew::files

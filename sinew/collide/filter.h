#pragma once

#include <cstdint>

namespace sinew::collide {

/// Membership in layers, and the layers that are touched: two things touch where each one's layers meet the other's
/// mask.
struct Filter {
    std::uint32_t layers = 1;
    std::uint32_t mask = ~std::uint32_t(0);

    friend constexpr bool operator==(const Filter&, const Filter&) = default;
    friend constexpr bool touch(const Filter& a, const Filter& b) {
        return (a.layers & b.mask) != 0 && (b.layers & a.mask) != 0;
    }
};

} // namespace sinew::collide

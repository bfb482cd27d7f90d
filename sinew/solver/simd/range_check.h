#pragma once

#include "sinew/math/lane.h"
#include "sinew/solver/simd/kernel.h"

#include <type_traits>

/// Kernel to find numbers beyond the limits.
namespace sinew {
namespace {

using namespace lane;

/// Bit patterns compared as integers: NaN is larger than any number.
template <bool negative, class Real> bool all_within(const Real* numbers, std::size_t count, Real limit) {
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    constexpr Bits no_sign = ~(Bits(1) << (8 * sizeof(Bits) - 1));
    constexpr int width = widest<Real>;
    const Bits max = __builtin_bit_cast(Bits, limit);
    const auto beyond = [max]<class V, class B>(const V& some, const B&) __attribute__((always_inline)) {
        const B bits = max - (__builtin_bit_cast(B, some) & no_sign); // highest bit set: beyond
        if constexpr (negative)
            return bits;
        else
            return bits | __builtin_bit_cast(B, V(some + Real(0))); // -0 counts as 0
    };
    Pack<Bits, width> packs{};
    std::size_t i = 0;
    for (; i + width <= count; i += width) packs |= beyond(load<Pack<Real, width>>(numbers + i), packs);
    Bits all = 0;
    for (int k = 0; k < width; ++k) all |= lane_of(packs, k);
    for (; i < count; ++i) all |= beyond(numbers[i], all);
    return all <= no_sign;
}

} // namespace
} // namespace sinew

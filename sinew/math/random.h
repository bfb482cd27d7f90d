#pragma once

#include <cstdint>

namespace sinew {

/// Counter-based random numbers: the n-th number of a stream is a pure function of (seed, stream, n). A generator has
/// no state to store or restore, and numbers can be drawn in any order. Mixing: the finaliser of splitmix64 (Steele,
/// Lea and Flood 2014).
namespace random {

constexpr std::uint64_t mix(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9U;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebU;
    return x ^ (x >> 31U);
}

constexpr std::uint64_t bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t n) {
    return mix(mix(mix(seed) ^ stream) ^ n);
}

/// Uniform in [0, 1).
template <class Real = double> constexpr Real uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t n) {
    return Real(double(bits(seed, stream, n) >> 40U) * 0x1p-24); // 24 bits: exact in float too
}

/// Uniform in [-1, 1).
template <class Real = double> constexpr Real symmetric(std::uint64_t seed, std::uint64_t stream, std::uint64_t n) {
    return Real(2) * uniform<Real>(seed, stream, n) - Real(1);
}

/// A random integer in [low, high]. All values are equally likely up to a bias below 2^-32.
constexpr std::int64_t whole(std::int64_t low, std::int64_t high, std::uint64_t seed, std::uint64_t stream,
                             std::uint64_t n) {
    const auto choices = std::uint64_t(high - low) + 1;
    return low + std::int64_t((bits(seed, stream, n) >> 32U) * choices >> 32U);
}

} // namespace random
} // namespace sinew

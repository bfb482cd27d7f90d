#pragma once

#include <cstdint>

namespace sinew {

/// Limits within which finite input can never become infinite or not-a-number, in float as in double. Values beyond a
/// limit are clamped to the limit. In the user's units.
namespace limit {
template <class Real> inline constexpr Real coordinate = Real(1e8);
template <class Real> inline constexpr Real speed = Real(1e12);
template <class Real> inline constexpr Real force = Real(1e15);
template <class Real> inline constexpr Real mass = Real(1e12);            ///< also of the inverse mass
template <class Real> inline constexpr Real measure = Real(1e26);         ///< limits of a constraint, and its alpha
template <class Real> inline constexpr Real multiplier = Real(1e25);      ///< multiplier of a constraint
template <class Real> inline constexpr Real step = Real(1e6);             ///< length of a step, time units
template <class Real> inline constexpr Real shortest_step = Real(1e-9);   ///< a shorter step is ignored
template <class Real> inline constexpr Real shortest_link = Real(1e-18);  ///< a shorter one has no direction
inline constexpr int row_bits = 28;                                       ///< the kind takes the other bits of 32
inline constexpr std::uint32_t rows = (std::uint32_t(1) << row_bits) - 1; ///< constraints of a kind in a world
} // namespace limit

/// Cosine between the old and the new gradient of a constraint from which the old one is used (simd/distance.h).
inline constexpr double min_agreement = 0.99;

/// Share of the maximum force from which a constraint slips: the force itself is only reached to within rounding.
inline constexpr double slipping_share = 0.999;

} // namespace sinew

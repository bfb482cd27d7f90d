#pragma once

/// What many tests are about.
namespace sinew {

inline constexpr double gravity = 9.81; ///< metres a second squared
inline constexpr double fps = 60;       ///< steps a second

} // namespace sinew

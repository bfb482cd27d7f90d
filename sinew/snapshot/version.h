#pragma once

#include <cstdint>

/// Versions of the format of snapshots.
namespace sinew::snapshot {

inline constexpr std::uint32_t version = 3, oldest_version = 1;
inline constexpr std::uint32_t version_with_steering = 2;      ///< in the session
inline constexpr std::uint32_t version_with_force_ids = 3;     ///< of the world's forces
inline constexpr std::uint32_t version_with_grabs = 3;         ///< of calls, in the session
inline constexpr std::uint32_t version_with_models = 3;        ///< of copies that are steered, in the session
inline constexpr std::uint32_t version_with_added_figures = 3; ///< in the session

} // namespace sinew::snapshot

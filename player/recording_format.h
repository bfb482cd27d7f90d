#pragma once

#include "sinew/math/hash.h"
#include "sinew/snapshot/bytes.h"

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

/// Frames of a recording: a type, for most types a length, the content, and a checksum.
///
///     step              u8 2, u32 hash, u16 checksum
///     drag, point       u8 3 or 4, u8 count, so many f64, u16 checksum
///     any other         u8 type, length in 7-bit digits, u16 checksum of these, content, u32 checksum
///
/// A checksum is the lower part of a hash of the frame and of all frames before. The length has one of its own: else a
/// damaged one could not be told from a file that ends early.
namespace sinew::play::format {

inline constexpr std::string_view magic = "SINEWREC";
inline constexpr std::uint32_t version = 1;
inline constexpr std::size_t head_size = 12;

enum class Type : std::uint8_t { scene, moment, step, drag, point, action, restart, back, places };
inline constexpr std::uint8_t types = std::uint8_t(Type::places) + 1;

/// True for frames without a length.
constexpr bool is_short(Type type) {
    return type == Type::step || type == Type::drag || type == Type::point;
}
/// Bytes of the checksum.
constexpr std::size_t checksum_size(Type type) {
    return is_short(type) ? 2 : 4;
}

/// The checksum of all frames, after one more.
inline std::uint64_t chained(std::uint64_t chain, std::span<const std::byte> frame) {
    Hash hash;
    hash.add(chain);
    hash.add(frame);
    return hash.value();
}

/// Checksum of a type and a length.
inline std::uint16_t head_checksum(std::uint64_t chain, std::span<const std::byte> head) {
    return std::uint16_t(chained(chain, head));
}

} // namespace sinew::play::format

namespace sinew::play {

/// True if bytes begin like a recording.
inline bool is_recording(std::span<const std::byte> bytes) {
    return bytes.size() >= format::magic.size() &&
           std::memcmp(bytes.data(), format::magic.data(), format::magic.size()) == 0;
}

} // namespace sinew::play

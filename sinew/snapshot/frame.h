#pragma once

#include "sinew/snapshot/snapshot.h"

#include <array>

/// Frame of a snapshot: a header, then parts of given lengths with their checksums.
///
///     8 bytes   "SINEWSNP"
///     u32       version of the format
///     u8        dimension          u8  bits of a number          u8  content          u8  0
///     3 parts   u64 length, u64 checksum (XXH3 of the header's first 16 bytes and the part)
///     bytes of the parts: fixed, moving, session
namespace sinew::snapshot {

inline constexpr std::size_t parts = 3;

struct Frame {
    std::uint32_t version = 0;
    SnapshotHeader header;
    std::array<std::span<const std::byte>, parts> part{};
    std::array<std::size_t, parts> at{}; ///< offset of each part
};

std::vector<std::byte> framed(const SnapshotHeader& header, const std::array<std::span<const std::byte>, parts>& part);
/// Nothing, and an error, for anything but a whole and undamaged frame of a known version.
std::optional<Frame> unframed(std::span<const std::byte> bytes, SnapshotError& error);

} // namespace sinew::snapshot

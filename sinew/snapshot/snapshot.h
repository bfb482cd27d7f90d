#pragma once

#include "sinew/snapshot/bytes.h"
#include "sinew/world/world.h"

#include <optional>
#include <span>
#include <vector>

/// A world as bytes, and back: on any machine, in any build of the same version, every later hash is that of the world
/// that never stopped. The bytes are little-endian and carry a version and checksums; fixed fields lie apart
/// from those that move. docs/reference/snapshot-format.md
///
/// Bytes may come from anybody. A world is replaced only by one that could have been built: otherwise nothing changes
/// and the error tells the place.
namespace sinew {

using snapshot::SnapshotError;

struct SnapshotLimits {
    std::uint64_t memory = 16'000'000'000; ///< bytes that a world may take once restored
};

/// Sort of the contents.
enum class SnapshotContent : std::uint8_t { world, session };

/// First bytes of a snapshot.
struct SnapshotHeader {
    int dimension = 2;
    int precision = 64; ///< bits of a number: 32 or 64
    SnapshotContent content = SnapshotContent::world;
};

/// True if bytes begin like a snapshot.
bool is_snapshot(std::span<const std::byte> bytes);
/// Reads the header, and checks versions, lengths and checksums; nothing on failure.
std::optional<SnapshotHeader> snapshot_header(std::span<const std::byte> bytes, SnapshotError& error);

/// The bytes of a world.
template <int D, class Real> std::vector<std::byte> save(const World<D, Real>& world);
/// Replaces a world by a saved one. On an error nothing changes.
template <int D, class Real>
std::optional<SnapshotError> restore(World<D, Real>& world, std::span<const std::byte> bytes,
                                     const SnapshotLimits& limits = {});

} // namespace sinew

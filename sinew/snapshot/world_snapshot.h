#pragma once

#include "sinew/snapshot/frame.h"

/// The parts of a snapshot that hold a world.
namespace sinew::snapshot {

struct WorldBytes {
    std::vector<std::byte> fixed, moving;
};

template <int D, class Real> WorldBytes bytes_of(const World<D, Real>& world);
/// Reads a fresh world; on an error the world is not to be used.
template <int D, class Real>
std::optional<SnapshotError> world_of(const Frame& frame, std::uint64_t memory, World<D, Real>& world);

} // namespace sinew::snapshot

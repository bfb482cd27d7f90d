#pragma once

#include "sinew/solver/world.h"

#include <algorithm>
#include <span>

namespace sinew {

/// Two particles that a distance joined until it was cut or torn.
using Ends = std::array<ParticleId, 2>;

/// Pairs of particles whose link is gone, each found in logarithmic time.
class Gaps {
  public:
    explicit Gaps(std::span<const Ends> gone) {
        for (const auto& ends : gone) keys_.push_back(key(ends[0], ends[1]));
        std::sort(keys_.begin(), keys_.end());
    }
    bool between(ParticleId a, ParticleId b) const { return std::binary_search(keys_.begin(), keys_.end(), key(a, b)); }

  private:
    static std::uint64_t key(ParticleId a, ParticleId b) {
        return std::uint64_t(std::min(a.slot, b.slot)) << 32 | std::max(a.slot, b.slot);
    }
    std::vector<std::uint64_t> keys_;
};

/// What is left of a figure's drawing.
struct PiecesLeft {
    std::vector<Piece> pieces;
    std::vector<Fragment> fragments;
};

template <int D, class Real> class Slicer;

/// What is drawn from one particle to another whose link is gone comes apart there: lines become shorter lines, closed
/// lines open, a filled polygon falls into the parts between its gaps. A patch of cloth is sliced, or goes where there
/// is no slicer.
template <int D, class Real>
void sever(World<D, Real>& world, std::span<const Ends> gone, const Slicer<D, Real>* slicer = nullptr);

} // namespace sinew

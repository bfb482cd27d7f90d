#pragma once

#include "sinew/math/sort.h"
#include "sinew/world/world.h"

#include <algorithm>
#include <span>

namespace sinew {

/// Two particles formerly joined by a distance, now cut or torn.
using Ends = std::array<ParticleId, 2>;

/// Pairs of particles with a removed link, with look-up in logarithmic time.
class Gaps {
  public:
    explicit Gaps(std::span<const Ends> gone) {
        for (const auto& ends : gone) keys_.push_back(key(ends[0], ends[1]));
        sinew::sort(keys_.begin(), keys_.end());
    }
    bool between(ParticleId a, ParticleId b) const { return std::binary_search(keys_.begin(), keys_.end(), key(a, b)); }

  private:
    static std::uint64_t key(ParticleId a, ParticleId b) {
        return std::uint64_t(std::min(a.index, b.index)) << 32 | std::max(a.index, b.index);
    }
    std::vector<std::uint64_t> keys_;
};

/// Remaining drawing of a figure.
struct PiecesLeft {
    std::vector<Piece> pieces;
    std::vector<Fragment> fragments;
};

template <int D, class Real> class Slicer;

/// Separates drawn pieces between particles whose link was removed: lines are divided, closed lines opened, filled
/// polygons divided at their gaps. Patches of cloth are sliced, or removed without a slicer.
template <int D, class Real>
void split_pieces(World<D, Real>& world, std::span<const Ends> gone, const Slicer<D, Real>* slicer = nullptr);

} // namespace sinew

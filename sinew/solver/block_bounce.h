#pragma once

#include "sinew/solver/block_settle.h"

/// The ends of joints where nothing is lost. A joint swings past its end for the rest of a substep, which keeps its
/// energy, and then all velocities are mirrored in those that would stop it: with P the projection on the motions that
/// the links, and the joints at their ends, allow (for the least change of momentum; Moreau 1962),
///
///     v -> 2 P v - v
///
/// which is as long as v, and leaves each end as fast as it came. A joint that comes back within one substep rests on
/// its end from then on: as long as it pushes it turns no further, which takes no work.
namespace sinew::detail {

template <int D> class BlockBounce {
  public:
    explicit BlockBounce(BlockEquations<D>& block) : block_(block), bends_(block.bends()) {}

    /// Velocities are those at the end of the swing. False where no joint has come to its end.
    bool run() {
        const bool landed = stop(true), struck = stop(false);
        return landed || struck;
    }

  private:
    BlockEquations<D>& block_;
    BlockBends<D>& bends_;

    /// Those that come back within the substep, or those that do not.
    bool stop(bool landing) {
        bool any = false;
        for (auto& bend : bends_.all()) {
            bend.strikes = bend.side == 0 && bends_.bounces(bend) && strikes(bend, landing);
            any = any || bend.strikes;
        }
        if (!any) return false;
        const auto nodes = block_.unknowns();
        settle_block(block_, [](double) {}); // keeps what they were in `aim`
        for (auto& bend : bends_.all()) {
            if (!bend.strikes) continue;
            if (landing)
                bend.tension = bend.pull / block_.substep();
            else
                bend.side = 0;
        }
        if (!landing)
            for (auto& node : nodes) node.velocity = node.velocity * 2 - node.aim;
        return true;
    }

    bool strikes(BlockBend<D>& bend, bool landing) {
        const double angle = bends_.angle_of(bend, false);
        bend.side = angle > bend.high ? 1 : angle < bend.low ? -1 : 0;
        const bool comes_back = bend.side != 0 && bends_.beyond(bend, bend.begun) >= 0;
        if (bend.side != 0 && comes_back == landing && bends_.rate_at_end(bend) * bend.side > 0) return true;
        bend.side = 0;
        return false;
    }
};

} // namespace sinew::detail

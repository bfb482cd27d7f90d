#pragma once

#include "sinew/solver/direct/project_velocities.h"

/// Bounces of joints, and of links limiting a joint's range, without loss of energy. A joint swings past the limit for
/// the rest of a substep, which conserves energy, and then all velocities are mirrored: with P the projection onto the
/// motions allowed by the links, and by the joints at their limits (for the least change of momentum; Moreau 1962),
///
///     v -> 2 P v - v
///
/// which has the norm of v, and leaves each limit at the speed of arrival. A joint back within one substep rests on the
/// limit from then on, if the approach is slow: pressed against the limit, the joint turns no further, which takes no
/// work.
namespace sinew::detail {

template <int D> class BlockBounce {
  public:
    /// `little`: energy that may be lost where a joint comes to rest on a limit, J.
    BlockBounce(BlockEquations<D>& block, double little) : block_(block), bends_(block.bends()), little_(little) {}

    /// Takes the velocities at the end of the swing. False if no joint has reached a limit.
    bool run() {
        const bool landed = stop(true), struck = stop(false);
        return landed || struck;
    }

  private:
    BlockEquations<D>& block_;
    AngleRows<D>& bends_;
    double little_;

    /// Stops the joints back within the substep if `landing`, otherwise reflects velocities at the others.
    bool stop(bool landing) {
        bool any = false;
        for (auto& bend : bends_.all()) {
            bend.strikes = bend.side == 0 && bends_.bounces(bend) && strikes(bend, landing);
            any = any || bend.strikes;
        }
        for (auto& link : block_.links().all()) {
            link.strikes = link.side == 0 && block_.links().bounces(link) && strikes(link, landing);
            if (link.strikes) link.tension = link.side; // makes the link resist in project_block_velocities
            any = any || link.strikes;
        }
        if (!any) return false;
        const auto nodes = block_.unknowns();
        const double kinetic = block_.kinetic();
        constexpr int rounds = 12; // enough to find which of many limits are loaded
        constexpr double rounding = 1e-6;
        project_block_velocities(
            block_, [](double) {}, rounds);                                  // keeps the old velocities in `predicted`
        const bool converged = block_.kinetic() <= (1 + rounding) * kinetic; // a projection gains nothing
        const bool rests = converged && landing && kinetic - block_.kinetic() <= little_;
        for (auto& bend : bends_.all()) {
            if (!bend.strikes) continue;
            if (rests)
                bend.tension = bend.pull / block_.substep();
            else
                bend.side = 0;
        }
        for (auto& link : block_.links().all()) {
            if (!link.strikes) continue;
            link.tension = rests ? link.pull / block_.substep() : 0;
            if (!rests) link.side = 0;
        }
        if (!rests)
            for (auto& node : nodes)
                node.velocity = converged ? node.velocity * 2 - node.predicted : node.predicted; // strikes again later
        return true;
    }

    bool strikes(DistanceRow<D>& link, bool landing) const {
        const auto &a = block_.node(link.a), &b = block_.node(link.b);
        const auto span = b.position - a.position;
        const auto side_of = [&](double length) { return length > link.high ? 1 : length < link.low ? -1 : 0; };
        link.side = side_of(norm(span));
        const bool comes_back = link.side != 0 && side_of(norm(link.start)) == link.side;
        if (link.side != 0 && comes_back == landing && dot(span, b.velocity - a.velocity) * link.side > 0) return true;
        link.side = 0;
        return false;
    }

    bool strikes(AngleRow<D>& bend, bool landing) {
        const double angle = bends_.geometry().angle_of(bend, false);
        bend.side = angle > bend.high ? 1 : angle < bend.low ? -1 : 0;
        const bool comes_back = bend.side != 0 && bends_.beyond(bend, bend.begun) >= 0;
        if (bend.side != 0 && comes_back == landing && bends_.geometry().rate_at_end(bend) * bend.side > 0) return true;
        bend.side = 0;
        return false;
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/solver/block.h"

namespace sinew::detail {

/// Update of the multipliers after a Newton step, and of the active set.
struct MultiplierUpdate {
    static constexpr int max_flips = 2;

    double share = 1;          ///< fraction of the step that was taken, 0..1
    bool elastic = false;      ///< limits are springs: multipliers stay zero
    bool releases = true;      ///< limits may be released
    bool any_released = false; ///< a rigid limit was released

    /// A limit whose multiplier has the wrong sign, by more than `slight`, is released, unless activated more than
    /// `max_flips` times in this substep.
    void renew(BlockLimit& limit, double next, double slight) {
        if (elastic) {
            limit.tension = 0;
            limit.side = limit.one_sided() && next * limit.side < 0 ? 0 : limit.side;
            return;
        }
        limit.tension = limit.side != 0 ? limit.tension + share * (next - limit.tension) : 0;
        const bool undecided = limit.flips > max_flips;
        if (releases && limit.one_sided() && !undecided && next * limit.side < -slight)
            limit.side = 0, limit.tension = 0, any_released = true;
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/math/scalar.h"

namespace sinew::detail {

/// Sizes of the last steps of an iteration, small where it has converged.
struct StepSizes {
    static constexpr double hardly = 1e-5;        ///< relative move after which the next would be too small to matter
    static constexpr double hardly_light = 1e-10; ///< same where light trees have velocities
    static constexpr double hardly_pulled = 3e-3; ///< same for a tension
    static constexpr double precise = 1e-11, nearly_precise = 1e-8; ///< same where rounding is all that is left
    static constexpr double stagnant = 0.25; ///< ratio to the last move, above which the iteration only rounds

    double moved = 0, moved_before = 0; ///< largest move of a node, in the last step and in the one before, m
    double tightened = 0;               ///< largest change of a tension in the last step, N
    double strongest = 0;               ///< largest tension, N

    bool are_small(double total_length, bool has_light_trees) const {
        return moved <= (has_light_trees ? hardly_light : hardly) * total_length &&
               tightened <= hardly_pulled * strongest;
    }
    /// True if the last move was no more than rounding.
    bool are_rounding(double total_length) const {
        return moved <= precise * total_length ||
               (moved <= nearly_precise * total_length && moved > stagnant * moved_before);
    }
};

} // namespace sinew::detail

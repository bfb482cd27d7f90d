#pragma once

namespace sinew::detail {

/// Integrator of a block's substep.
enum class Rule {
    midpoint, ///< midpoint rule, links pulling along the mean of the old and new directions (LaBudde and Greenspan
              ///< 1976; Gonzalez 1999): conserves energy to rounding, at any step
    backward_euler, ///< backward Euler, links pulling along the new directions: dissipative, stable at any step
    shake, ///< correction of predicted positions within a sweep, links pulling along the old directions (SHAKE:
           ///< Ryckaert, Ciccotti and Berendsen 1977)
    static_projection ///< static projection: the nearest positions with the right lengths
};

} // namespace sinew::detail

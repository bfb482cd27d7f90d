#pragma once

namespace sinew::detail {

/// How a substep gets from where it began to where it ends.
enum class Rule {
    swing, ///< the midpoint rule, links pulling along the mean of their old and new directions (LaBudde and Greenspan
           ///< 1976; Gonzalez 1999): keeps energy to rounding, whatever the step
    implicit, ///< backward Euler, links pulling along their new directions: loses energy, and stands anything
    place     ///< no time passes: the nearest place where the links have their lengths
};

} // namespace sinew::detail

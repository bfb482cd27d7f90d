#pragma once

#include "sinew/math/limit.h"
#include "sinew/world/world.h"

/// The spring and the damper of a soft pin. With e the offset from the target, u the change of e in a substep, and w
/// the inverse mass (or the response of the figure), force = -(k e + c u / h), where
///
///     k = 1 / compliance,    c = damping * 2 sqrt(k / w)      (damping 1 is critical)
///
/// The sweep solves for the multiplier (XPBD): dlambda = -(e + alpha lambda + gamma u) / (w (1 + gamma) + alpha) with
/// alpha = compliance / h^2 and gamma = c compliance / h; the direct solver adds k and c / h to the matrix of a node.
namespace sinew::detail {

/// gamma, limited; `T` is the precision of the solution.
template <int D, class Real, class T> T pin_gamma(const Pin<D, Real>& pin, T w, T per_h) {
    return min(T(2) * T(pin.damping) * square_root(T(pin.compliance)) * square_root(inverse_or_zero(w)) * per_h,
               T(limit::measure<Real>));
}

/// k, at most `hardest`: the penalty stiffness for a rigid pin with a maximum force.
template <int D, class Real> double pin_stiffness(const Pin<D, Real>& pin, double hardest) {
    return pin.is_rigid() ? hardest : min(1 / double(pin.compliance), hardest);
}

/// c, of a pin with stiffness k on a mass.
template <int D, class Real> double pin_damper(const Pin<D, Real>& pin, double k, double mass) {
    return double(pin.damping) * 2 * square_root(k * mass);
}

} // namespace sinew::detail

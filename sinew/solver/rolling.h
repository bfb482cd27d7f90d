#pragma once

#include "sinew/math/moments.h"
#include "sinew/table/id.h"

#include <vector>

namespace sinew {

struct RollingRows {
    std::vector<Row> rows;     ///< particles that roll
    std::vector<char> is_held; ///< scratch, per particle: by a constraint
};

/// Turn of a swept particle as a ball, by lengths: radius times angle, about the axis of rotation.
template <int D, class Real> struct Roller {
    Vec<spins<D>, Real> rim{};    ///< displacement of the rim in the substep
    Vec<spins<D>, Real> rolled{}; ///< sum of these since the step began
    Real per_inertia = 0;         ///< mass radius^2 / moment of inertia; 0: does not roll
};

/// Displacement of the point of contact by a turn; `normal` points from the contact to the particle's centre, or away
/// from it at the far side of a contact between two.
///
///     omega x (-r n) = n x (r omega)
template <class T> Vec<2, T> slip_of_rim(const Vec<1, T>& rim, const Vec<2, T>& normal) {
    return perpendicular(normal) * -rim[0];
}
template <class T> Vec<3, T> slip_of_rim(const Vec<3, T>& rim, const Vec<3, T>& normal) {
    return cross(normal, rim);
}

/// Change of the rim's displacement for a tangential impulse at the contact, per r^2 / inertia; of both of a contact
/// between two, for the impulse on the first:
///
///     r d(omega) = (r^2 / I) (-n x t)
template <int D, class T> Vec<spins<D>, T> turn_of_rim(const Vec<D, T>& normal, const Vec<D, T>& impulse) {
    return -moment(normal, impulse);
}

} // namespace sinew

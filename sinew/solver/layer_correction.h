#pragma once

#include "sinew/math/vec.h"

namespace sinew::detail {

/// Share of an overlap of layers removed in a substep. All at once would leave the layers with its speed: undamped
/// cloth never rested (docs/measured/contact.md).
template <class Real> inline constexpr Real layer_push_out = Real(0.25);

/// Change of the relative displacement of two layers that overlap: stops their approach, and moves them apart by a
/// share of the overlap that there was before; friction takes back the slip. `displacement`: relative, along the normal
/// apart.
template <int D, class Real>
Vec<D, Real> layer_correction(const Vec<D, Real>& normal, const Vec<D, Real>& displacement, Real overlap,
                              Real friction) {
    const Real along = dot(displacement, normal), approach = max(-along, Real(0));
    const Real pushed = min(overlap, approach) + layer_push_out<Real> * max(overlap - approach, Real(0));
    const auto across = displacement - normal * along;
    return normal * pushed - across * min(Real(1), friction * pushed * inverse_or_zero(norm(across)));
}

} // namespace sinew::detail

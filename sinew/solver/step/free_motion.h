#pragma once

#include "sinew/world/integrator.h"

#include <type_traits>

/// Integrators of a free particle over a step h, written for displacements: `change` is h v, and `gain(position,
/// change)` is h^2 a, the increment of `change`.
namespace sinew {

/// State of a free particle.
template <class Vector> struct FreeMotion {
    Vector position{};
    Vector change{}; ///< h v
};

template <class Vector, class Gain> FreeMotion<Vector> explicit_euler(const FreeMotion<Vector>& now, Gain&& gain) {
    return {now.position + now.change, now.change + gain(now.position, now.change)};
}

/// Equal to Verlet in positions, with `change` = x - x_prev.
template <class Vector, class Gain> FreeMotion<Vector> symplectic_euler(const FreeMotion<Vector>& now, Gain&& gain) {
    const auto change = now.change + gain(now.position, now.change);
    return {now.position + change, change};
}

/// The second gain is taken at the new position, with the velocity predicted by the first (Heun): of second order for
/// velocity-dependent forces, too.
template <class Vector, class Gain> FreeMotion<Vector> velocity_verlet(const FreeMotion<Vector>& now, Gain&& gain) {
    using Real = std::decay_t<decltype(now.position[0])>;
    const auto before = gain(now.position, now.change);
    const auto position = now.position + now.change + before * Real(0.5);
    const auto after = gain(position, now.change + before);
    return {position, now.change + (before + after) * Real(0.5)};
}

template <class Vector, class Gain> FreeMotion<Vector> rk4(const FreeMotion<Vector>& now, Gain&& gain) {
    using Real = std::decay_t<decltype(now.position[0])>;
    const auto slope = [&](const FreeMotion<Vector>& at) {
        return FreeMotion<Vector>{at.change, gain(at.position, at.change)};
    };
    const auto ahead = [&](const FreeMotion<Vector>& k, Real share) {
        return FreeMotion<Vector>{now.position + k.position * share, now.change + k.change * share};
    };
    const auto k1 = slope(now);
    const auto k2 = slope(ahead(k1, Real(0.5)));
    const auto k3 = slope(ahead(k2, Real(0.5)));
    const auto k4 = slope(ahead(k3, Real(1)));
    constexpr Real sixth = Real(1) / Real(6), third = Real(1) / Real(3);
    return {now.position + (k1.position + k4.position) * sixth + (k2.position + k3.position) * third,
            now.change + (k1.change + k4.change) * sixth + (k2.change + k3.change) * third};
}

/// Advances a particle by a step of the integrator.
template <class Vector, class Gain>
FreeMotion<Vector> advance(Integrator integrator, const FreeMotion<Vector>& now, Gain&& gain) {
    switch (integrator) {
    case Integrator::explicit_euler:
        return explicit_euler(now, gain);
    case Integrator::velocity_verlet:
        return velocity_verlet(now, gain);
    case Integrator::rk4:
        return rk4(now, gain);
    case Integrator::verlet:
    case Integrator::symplectic_euler:
        break;
    }
    return symplectic_euler(now, gain);
}

} // namespace sinew

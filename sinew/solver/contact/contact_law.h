#pragma once

#include "sinew/math/scalar.h"
#include "sinew/math/vec.h"

#include <optional>

/// Laws of contact, once for all solvers: of planes, of colliders (a plane at each contact) and of figures, in the
/// sweep and in Newton's iteration.
namespace sinew::detail {

/// Displacement, or velocity, of a particle relative to a surface.
template <int D, class T> struct RelativeMotion {
    T approach{}; ///< towards the surface
    Vec<D, T> along{};

    RelativeMotion(const Vec<D, T>& normal, const Vec<D, T>& motion)
        : approach(-dot(normal, motion)), along(motion + normal * approach) {}
};

/// Coulomb's law: the share of a tangential displacement (of the given size) that friction stops, or of a tangential
/// force that it bears, up to friction times the normal one.
template <class T> T coulomb_share(T bound, T size) {
    return min(T(1), bound * inverse_or_zero(size));
}

/// Newton's law of restitution: the speed of separation after an approach; none after an approach so slow that it is
/// resting contact: up to four times what the forces add in a substep. Speeds, or displacements of a substep.
template <class T> std::optional<T> rebound_after(T approach, T restitution, T added_by_forces) {
    if (!(approach > T(4) * added_by_forces)) return std::nullopt;
    return restitution * approach;
}

/// Depth at which a surface holds a particle that begins the substep `begun` deep behind it. An overlap is left at the
/// speed of a body thrown up from its bottom to the surface, v^2 = 2 a depth, so that nothing shoots out; without
/// forces by a two-hundredth of the depth. Overlaps below 2 a h^2 end at once.
template <class T> T depth_left(T begun, T acceleration, T h) {
    constexpr T share = T(1) / T(200);
    return begun - min(begun, max(h * square_root(T(2) * acceleration * begun), share * begun));
}

} // namespace sinew::detail

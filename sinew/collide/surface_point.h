#pragma once

#include "sinew/math/vec.h"

#include <cstdint>
#include <limits>

namespace sinew::collide {

/// Point of a surface nearest to some point.
template <int D, class Real> struct SurfacePoint {
    Vec<D, Real> point{};                             ///< on the surface
    Vec<D, Real> normal{};                            ///< unit length, outwards
    Real distance = std::numeric_limits<Real>::max(); ///< signed, negative inside
    std::uint32_t feature = 0;                        ///< face, edge or corner of the shape
};

/// Depth behind a part of a surface from which spheres are still pushed out, as a share of the part's size: contacts
/// give a little.
template <class Real> inline constexpr Real share_behind = Real(0.02);

/// Nearest approach of a surface and a segment.
template <int D, class Real> struct SegmentApproach {
    Real t = 0; ///< parameter on the segment, 0..1
    SurfacePoint<D, Real> surface{};
};

/// First contact of a moving point, sphere or capsule with a surface.
template <int D, class Real> struct Impact {
    Real time = 0; ///< fraction of the motion, 0..1
    SurfacePoint<D, Real> surface{};
};

/// Surface point on a sharp feature (corner, edge): the normal points to the outside point, or along `fallback` if both
/// coincide.
template <int D, class Real>
SurfacePoint<D, Real> sharp_point(const Vec<D, Real>& feature, const Vec<D, Real>& outside,
                                  const Vec<D, Real>& fallback, std::uint32_t number) {
    const auto away = outside - feature;
    const Real length = norm(away), per = inverse_or_zero(length);
    return {feature, per > Real(0) ? away * per : fallback, length, number};
}

} // namespace sinew::collide

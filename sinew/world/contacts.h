#pragma once

#include "sinew/math/vec.h"
#include "sinew/table/id.h"

#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

namespace sinew {

struct ColliderTag;
using ColliderId = Id<ColliderTag>;

/// Slots of the planes of a world, among those of colliders: their numbers, with the highest bit.
inline constexpr std::uint32_t plane_bit = std::uint32_t(1) << 31U;
constexpr bool is_plane(std::uint32_t slot) {
    return (slot & plane_bit) != 0 && slot != ~std::uint32_t(0);
}

/// Features in contact, which outlive the motion of rows: slots of particles, of a collider or of a plane.
struct ContactKey {
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    static constexpr std::uint32_t face = 3; ///< feature of the corners of a face and a particle, in space
    std::array<std::uint32_t, 4> particle = {none, none, none, none}; ///< slots: of one side, then of the other
    std::uint32_t collider = none;                                    ///< slot of a collider or of a plane
    std::uint32_t feature = 0;
    friend constexpr auto operator<=>(const ContactKey&, const ContactKey&) = default;
};

/// Multipliers of a contact, kept from substep to substep. Without them a pile would carry its load by being violated.
template <int D, class Real> struct KeptContact {
    ContactKey key{};
    Real multiplier = 0;     ///< h newton seconds, along the normal; >= 0
    Vec<D, Real> friction{}; ///< multiplier of friction
};

/// Strength of a touch; no part of the state, which a step reads.
struct TouchStrength {
    double impulse = 0; ///< in the last step, newton seconds
    double blow = 0;    ///< the same; in the step after the touch began, that of both: a blow may take two
    double blow_before = 0;
    bool is_new = false; ///< began in the last step

    /// True if the touch reaches an impulse that it did not reach in the step before.
    bool is_hit(double threshold) const { return blow >= threshold && (is_new || blow_before < threshold); }
};

/// Place of a touch, where and when it pressed hardest in the last step; no part of the state, which a step reads.
struct TouchPlace {
    std::array<double, 3> point{};  ///< of the surface; in 2D the third number is 0
    std::array<double, 3> normal{}; ///< unit length, towards the particle, or from the second figure to the first; zero
                                    ///< for a body that is near and does not press
    double speed = 0;               ///< of approach along the normal, before the contact acts, length per time
};

/// Touch of a particle and a collider or a plane, by their slots.
struct ColliderTouch {
    std::uint32_t particle = 0, collider = 0;
    TouchStrength strength{};
    TouchPlace place{};
    friend constexpr auto operator<=>(const ColliderTouch& a, const ColliderTouch& b) {
        return std::tie(a.particle, a.collider) <=> std::tie(b.particle, b.collider);
    }
    friend constexpr bool operator==(const ColliderTouch& a, const ColliderTouch& b) { return (a <=> b) == 0; }
};

/// Touch of two figures, or of a figure with itself.
struct FigureTouch {
    FigureIndex first = no_figure, second = no_figure; ///< first <= second
    std::array<std::uint32_t, 2> particle{};           ///< slots: of either side, where they press hardest
    double hardest = 0;                                ///< impulse there, newton seconds
    TouchStrength strength{};
    TouchPlace place{};
    friend constexpr auto operator<=>(const FigureTouch& a, const FigureTouch& b) {
        return std::tie(a.first, a.second) <=> std::tie(b.first, b.second);
    }
    friend constexpr bool operator==(const FigureTouch& a, const FigureTouch& b) { return (a <=> b) == 0; }
};

template <int D, class Real> struct Contacts {
    std::vector<KeptContact<D, Real>> kept; ///< in the order of their keys
    Real kept_substep = 0;                  ///< length of the substep of the kept multipliers
    std::vector<KeptContact<D, Real>>
        passing;                         ///< of figures in the last substep, not kept: of cloth; no part of the state
    std::vector<ColliderTouch> touching; ///< in the last step, in order

    bool lists_planes = false;        ///< set by whoever wants touches of World::bounds listed and reported
    bool lists_figures = false;       ///< the same of figures
    std::vector<FigureTouch> figures; ///< in the last step, in order
    /// A touch whose blow reaches this, and did not in the step before, is reported as a hit.
    double hit_impulse = std::numeric_limits<double>::infinity();
};

} // namespace sinew

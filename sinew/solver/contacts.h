#pragma once

#include "sinew/collide/bounding_box.h"
#include "sinew/collide/broadphase.h"
#include "sinew/solver/id.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sinew {

struct ColliderTag;
using ColliderId = Id<ColliderTag>;

/// Features of a contact, which outlive the motion of rows: slots of particles, and of a collider.
struct ContactKey {
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    std::array<std::uint32_t, 4> particle = {none, none, none, none}; ///< slots: one side's, then the other's
    std::uint32_t collider = none;                                    ///< slot of a collider, or number of a plane
    std::uint32_t feature = 0;
    friend constexpr auto operator<=>(const ContactKey&, const ContactKey&) = default;
};

/// A row of contact:  gap = gap_begun + sum of weight * dot(normal, displacement)  >= 0.
template <int D, class Real> struct ContactRow {
    using Vector = Vec<D, Real>;
    ContactKey key{};
    std::array<Row, 4> particle{};
    std::array<Real, 4> weight{}; ///< derivatives of the gap along the normal: sums to 0, or to 1 against a collider
    std::array<Row, 4> slot{};    ///< of the sweep
    int particles = 0;
    Vector normal{};       ///< towards the first side
    Vector surface_move{}; ///< displacement of a collider in the substep
    Real gap = 0;          ///< at the start of the substep, metres; negative where things overlap
    Real mass = 0;         ///< 1 / sum of weight^2 inverse mass
    Real friction = 0, restitution = 0;
    Real multiplier = 0;      ///< kept from substep to substep, h newton seconds; >= 0
    Vector tangent{};         ///< multiplier of friction
    Real approach = 0;        ///< speed before the contact acted, for the rebound
    bool was_pressed = false; ///< in this step
};

/// Contacts of the world. The rows with their multipliers are state; all else is room for a step.
template <int D, class Real> struct Contacts {
    std::vector<ContactRow<D, Real>> rows; ///< in the order of their keys

    struct Touching {
        std::uint32_t particle = 0, collider = 0; ///< slots
        friend constexpr auto operator<=>(const Touching&, const Touching&) = default;
    };
    std::vector<Touching> touching; ///< pairs that touched in the last step, in order

    // Room for a step.
    std::vector<Touching> touching_before;
    std::vector<collide::BoundingBox<D, Real>> boxes; ///< of the colliders during the step
    std::vector<std::uint32_t> touched;               ///< per particle: 1 + index of the collider pressed hardest, or 0
    std::vector<Real> pressed;                        ///< per particle: impulse of that collider, newton seconds
};

} // namespace sinew

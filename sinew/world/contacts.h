#pragma once

#include "sinew/math/vec.h"
#include "sinew/table/id.h"

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

namespace sinew {

struct ColliderTag;
using ColliderId = Id<ColliderTag>;

/// Features in contact, which outlive the motion of rows: slots of particles, of a collider or of a plane.
struct ContactKey {
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    std::array<std::uint32_t, 4> particle = {none, none, none, none}; ///< slots: of one side, then of the other
    std::uint32_t collider = none; ///< slot of a collider; with the highest bit, number of a plane
    std::uint32_t feature = 0;
    friend constexpr auto operator<=>(const ContactKey&, const ContactKey&) = default;
};

/// Multipliers of a contact, kept from substep to substep. Without them a pile would carry its load by being violated.
template <int D, class Real> struct KeptContact {
    ContactKey key{};
    Real multiplier = 0;     ///< h newton seconds, along the normal; >= 0
    Vec<D, Real> friction{}; ///< multiplier of friction
};

/// Touch of a particle and a collider, by their slots.
struct ColliderTouch {
    std::uint32_t particle = 0, collider = 0;
    friend constexpr auto operator<=>(const ColliderTouch&, const ColliderTouch&) = default;
};

template <int D, class Real> struct Contacts {
    std::vector<KeptContact<D, Real>> kept; ///< in the order of their keys
    Real kept_substep = 0;                  ///< length of the substep of the kept multipliers
    std::vector<ColliderTouch> touching;    ///< in the last step, in order
};

} // namespace sinew

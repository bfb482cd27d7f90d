#pragma once

#include "sinew/world/contacts.h"

namespace sinew {

/// A row of contact between features of figures, or of a figure and a wall, in one substep:
///
///     gap + sum of weight_i dot(normal, displacement_i) - dot(normal, surface_move)  >=  0
template <int D, class Real> struct ContactRow {
    using Vector = Vec<D, Real>;
    ContactKey key{};
    std::array<Row, 4> slot{};    ///< slots of the sweep
    std::array<Real, 4> weight{}; ///< shares of the contact point, positive on the normal's side
    int members = 0;
    std::uint32_t collider = ~std::uint32_t(0); ///< index of a collider, if there is one
    Vector normal{};
    Vector surface_move{}; ///< displacement of a wall in the substep
    Real gap = 0;          ///< at the start of the substep, metres; negative for an overlap
    Real mass = 0;         ///< 1 / sum of weight^2 inverse mass
    Real friction = 0, restitution = 0;
    Real multiplier = 0; ///< h newton seconds, >= 0
    Vector tangent{};    ///< multiplier of friction
    Real approach = 0;   ///< approach in a substep before the contact acts, metres
    Real most = 0;       ///< largest multiplier in this substep
    bool keeps = true;   ///< the multiplier outlasts the substep
};

/// Pair of features that may touch in a step. Particles are numbered first, then segments.
struct ContactCandidate {
    std::uint32_t first = 0, second = 0;
    friend constexpr auto operator<=>(const ContactCandidate&, const ContactCandidate&) = default;
};

/// Link of a figure as a capsule.
struct ContactSegment {
    Row a = 0, b = 0;
    FigureIndex figure = no_figure;
    int side = 0; ///< 2D: 1 or -1 where the figure is solid to the right or to the left of a-b; 0: solid nowhere
    std::uint32_t first = 0, count = 0; ///< segments around the same solid
};

} // namespace sinew

#pragma once

#include "sinew/math/matrix.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/world/contacts.h"

#include <algorithm>
#include <limits>
#include <span>

namespace sinew {

/// Link on one side of a row. Its surface, at which friction acts, turns with it: with u the displacements of its ends,
///
///     displacement of the surface = that of its line + omega x (-r n),   omega = d x (u_b - u_a) / length
///
/// with d the direction of the link; its share in the displacement of the contact has the sign of the weights. In space
/// a link does not turn about itself.
template <int D, class Real> struct ContactLever {
    using Vector = Vec<D, Real>;
    Real radius = 0;
    Vector along{};            ///< -d r / length, with r the radius times the arm of the row
    std::uint8_t a = 0, b = 0; ///< members at its ends

    Vector turned(const Vector& normal, const Vector& between) const {
        return between * dot(along, normal) - along * dot(normal, between);
    }
    /// Impulse on the end b, and against the end a, for one on the surface: the transpose.
    Vector couple(const Vector& normal, const Vector& impulse) const {
        return impulse * dot(along, normal) - normal * dot(along, impulse);
    }
};

/// A row of contact between features of figures, or of a figure and a wall, in one substep:
///
///     gap + sum of weight_i dot(normal, displacement_i) - dot(normal, surface_displacement)  >=  0
///
/// All passes over the rows read these numbers.
template <int D, class Real> struct ContactRow {
    using Vector = Vec<D, Real>;
    static constexpr std::size_t most = D == 2 ? 4 : 5, most_levers = D == 2 ? 2 : 3; ///< members
    std::array<Row, most> slot{};                                                     ///< slots of the sweep
    std::array<Real, most> weight{}; ///< shares of the contact point, positive on the normal's side
    std::array<ContactLever<D, Real>, most_levers> lever{};
    Vector normal{};
    Vector tangent{}; ///< multiplier of friction
    Real gap = 0;     ///< at the start of the substep, metres; negative for an overlap
    Real mass = 0;    ///< 1 / sum of weight^2 inverse mass
    Real friction = 0;
    Real multiplier = 0; ///< h newton seconds, >= 0
    Real max = 0;        ///< largest multiplier in this substep
    Real load = 1;       ///< mass that the row carries, as a multiple of the one moved
    Real arm = 0;        ///< at which friction turns balls and links, as a share of their radii; 0: it turns nothing
    std::uint8_t members = 0, levers = 0;
    bool keeps = true; ///< the multiplier outlasts the substep
    bool acts_on_clusters = false;
    bool is_held = false;     ///< solved as the whole figures answer
    bool is_repeated = false; ///< solved with the rows of its island, until they agree (row_islands.h)
    bool is_central = false;  ///< the normal is the line of centres, and turns with it
    bool is_on_face = false;  ///< of a particle, and the corners of a face of a solid in space
    signed char side = 0;     ///< 2D: of the segment on which the particle is, 1: left of a-b

    std::span<const Row> slots() const { return std::span(slot).first(members); }
    /// Displacement of the contact by that of a member.
    Vector by_member(std::size_t i, const Vector& moved) const {
        auto sum = moved * weight[i];
        for (std::size_t k = 0; k < levers; ++k)
            if (lever[k].a == i || lever[k].b == i) sum += lever[k].turned(normal, lever[k].b == i ? moved : -moved);
        return sum;
    }
    /// Impulse on a member for one on the contact: the transpose.
    Vector on_member(std::size_t i, const Vector& impulse) const {
        auto sum = impulse * weight[i];
        for (std::size_t k = 0; k < levers; ++k)
            if (lever[k].a == i || lever[k].b == i)
                sum += lever[k].couple(normal, lever[k].b == i ? impulse : -impulse);
        return sum;
    }
};

/// The rest of a row.
template <int D, class Real> struct ContactOrigin {
    static constexpr Real share_of_deep = Real(0.5); ///< of `thickness`

    Vec<D, Real> surface_displacement{};          ///< displacement of a wall in the substep
    Real deep = std::numeric_limits<Real>::max(); ///< depth from which the row is held as the figures answer
    Real thickness = 0;                           ///< sum of the radii of two figures
    Real restitution = 0;
    Real approach = 0;                          ///< approach in a substep before the contact acts, metres
    std::uint32_t source = 0;                   ///< index of the candidate, or of the key of a wall
    std::uint32_t collider = ~std::uint32_t(0); ///< index of a collider, if there is one
    Real pushed = 0;                            ///< impulse in the substep apart from the multiplier, h newton seconds
    bool is_one_way = false; ///< the collider holds only what it held before, or comes from its front

    /// Arm of friction on two figures whose lines are so far apart.
    Real arm_at(Real distance) const { return max(distance / thickness, Real(0.1)); }
};

/// Row solved as whole figures answer.
struct HeldRow {
    std::uint32_t row = 0;
    std::uint32_t component = 0; ///< of rigid links, of the light particle
};

/// Row solved with others until they agree (settle_rows.h). Impulses are h newton seconds.
template <int D, class Real> struct IslandRow {
    std::uint32_t island = 0, part = 0, row = 0; ///< first body, or component of rigid links; part, and index in it
    Vec<D, Real> change{}, direction{};
};

/// Masses of the bodies of an island, kg.
template <class Real> struct IslandMasses { Real lightest = std::numeric_limits<Real>::max(), heaviest = 0; };

/// Row of a blow. Displacements are those along the normal in a substep.
template <class Real> struct ReboundRow {
    std::uint32_t group = 0, part = 0, row = 0; ///< first of the figures that rebound together; part, and index in it
    Real added = 0;                             ///< displacement by half of the forces in the substep
    Real of_surface = 0;                        ///< displacement of the wall
    Real before = 0;                            ///< displacement before the blow
    Real target = 0;                            ///< displacement after it, at least
    Real impulse = 0;                           ///< h newton seconds
    std::uint32_t strikes = 0;                  ///< in the substep
};

/// Scratch of the Delassus operator of a group of rows (delassus.h).
template <int D, class Real> struct DelassusRoom {
    struct Contact {
        ContactRow<D, Real>* row = nullptr;
        Vec<D, Real> moved{};            ///< displacement by members with links
        Vec<D, Real> impulse{};          ///< not given to these members yet, h newton seconds
        Matrix<D, Real> own{};           ///< response to an impulse of its own, 1 / kg
        Real mass = 0;                   ///< 1 / response along the normal, kg
        std::size_t first = 0, last = 0; ///< entries
        bool is_known = false, is_kept = false, has_lone = false;
    };
    /// Displacement of a contact for an impulse at another, 1 / kg.
    struct Entry {
        std::uint32_t contact = 0;
        Matrix<D, Real> response{};
    };
    /// Contact of a component of rigid links.
    struct Touching {
        std::uint32_t component = 0, contact = 0;
        friend constexpr auto operator<=>(const Touching&, const Touching&) = default;
    };
    std::vector<Contact> contacts;
    std::vector<Entry> entries;
    std::vector<Touching> touching;
    std::vector<Matrix<D, Real>> responses;
};

/// Kinetic energy of a body, or an island of bodies, before and after a warm start (warm_start.h); times h^2.
struct WarmGain {
    double before = 0, gained = 0;
    double of_change = 0;   ///< of the change of the displacements alone
    bool is_pushed = false; ///< by something that moves

    template <class Vector, class Real> void add(const Vector& from, const Vector& to, Real mobility) {
        const double mass = 0.5 / double(mobility);
        before += mass * double(dot(from, from));
        gained += mass * double(dot(to - from, to + from));
        of_change += mass * double(dot(to - from, to - from));
    }
    WarmGain& operator+=(const WarmGain& other) {
        before += other.before, gained += other.gained, of_change += other.of_change;
        is_pushed = is_pushed || other.is_pushed;
        return *this;
    }
    bool is_large() const {
        constexpr double most = 30; // a heavy head on light feet falls to and fro by less until its rows agree
        return gained > most * before;
    }
    /// Share of the change at which the energy is least, where it has risen.
    double share() const {
        if (is_pushed || !is_large()) return 1;
        return std::clamp(0.5 * (1 - gained / of_change), 0.0, 1.0);
    }
};

/// Pair of features that may touch in a step. Particles are numbered first, then segments, then solids in space; first
/// > second.
struct ContactCandidate {
    std::uint32_t first = 0, second = 0;
    friend constexpr auto operator<=>(const ContactCandidate&, const ContactCandidate&) = default;
};

/// Multipliers of a candidate or a wall, from substep to substep.
template <int D, class Real> struct ContactMultiplier {
    Real normal = 0;
    Vec<D, Real> tangent{};
    int side = 0; ///< 2D: of the segment, while the features touch; 0: unknown
};

/// Particle of a colliding figure.
template <class Real> struct ContactParticle {
    Row row = 0, slot = 0; ///< slot of the sweep
    FigureIndex figure = no_figure;
    bool in_segment = false;
    bool is_covered = false; ///< by a segment as wide as the particle: nothing touches the particle and no segment
    Real radius = 0;
    Real friction = 0, restitution = 0;
    std::uint32_t strip = 0;                  ///< part of the world (contact_parts.h)
    std::uint32_t beside = ~std::uint32_t(0); ///< number of the other end of a segment that it is in
};

/// Link of a figure as a capsule.
struct ContactSegment {
    Row a = 0, b = 0;
    FigureIndex figure = no_figure;
    int side = 0; ///< 2D: 1 or -1 where the figure is solid to the right or to the left of a-b; 0: solid nowhere
    bool is_inner = false;                    ///< between two filled areas of a figure: nothing touches it
    std::uint32_t first = 0, count = 0;       ///< segments around the same solid
    std::uint32_t number_a = 0, number_b = 0; ///< of the ends, among the particles
    std::uint32_t edge = ~std::uint32_t(0);   ///< of a solid in space
    friend bool operator==(const ContactSegment&, const ContactSegment&) = default;
};

/// Number of parts (contact_parts.h).
inline constexpr std::uint32_t contact_parts = 16;

/// Rows and candidates that one thread looks after. Parts of a phase share no particle.
template <int D, class Real> struct ContactPart {
    std::uint32_t first = 0, last = 0;                      ///< range of candidates
    std::vector<std::uint32_t> particles, segments, solids; ///< numbers of those whose walls it looks after
    std::vector<std::uint32_t> near_planes;                 ///< of these particles, those that may touch a plane
    std::vector<ContactRow<D, Real>> rows;                  ///< of the candidates, then of walls
    std::vector<ContactOrigin<D, Real>> origins;            ///< of the rows
    std::vector<NearSegment<D, Real>> near;                 ///< scratch: candidates that may touch in this substep
    std::vector<std::uint32_t> deep;                        ///< rows that may have to be held as the figures answer
    std::vector<HeldRow> held;                              ///< rows solved as the figures answer
    std::size_t first_wall = 0;                             ///< index of the first row of a wall
    std::vector<ContactKey> wall_keys;
    std::vector<ContactRow<D, Real>> sensed;            ///< links near sensors, which do not act
    std::vector<ContactOrigin<D, Real>> sensed_origins; ///< of these
};

} // namespace sinew

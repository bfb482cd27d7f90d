#pragma once

#include "sinew/math/moments.h"

#include <cstddef>
#include <cstdint>

/// Components of rigid links side by side in the lanes of packs, a component to a lane.
namespace sinew {

/// Most components of a pack.
inline constexpr std::size_t max_link_lanes = 8;

inline constexpr std::uint32_t no_member = ~std::uint32_t(0);

/// Particles of a component that move as one rigid body: a range of its members.
struct LinkCluster {
    std::uint32_t first = 0, last = 0;
    friend constexpr bool operator==(const LinkCluster&, const LinkCluster&) = default;
};

/// Link of a component, and its row in the skyline of G M^-1 G^T. Particles and links are numbered within the
/// component.
struct LinkRow {
    std::uint32_t a = 0, b = 0; ///< particles
    std::uint32_t first = 0;    ///< first column
    std::uint32_t start = 0;    ///< first entry
    std::uint32_t is_rope = 0;  ///< may be shorter than its length
    std::uint32_t moves = 0;    ///< bits: a can move, b can move
    std::uint32_t member_a = no_member, member_b = no_member; ///< numbers among the members of clusters
    std::uint32_t cluster_a = no_member, cluster_b = no_member;
    friend constexpr bool operator==(const LinkRow&, const LinkRow&) = default;
};

/// Fields of the records of a pack.
template <int D> struct LinkFields {
    // Numbers of a particle.
    static constexpr std::size_t displacement = 0, before = D; ///< before: the lengths were corrected
    static constexpr std::size_t added = 2 * D;                ///< correction
    static constexpr std::size_t mobility = 3 * D, mass = mobility + 1, of_particle = mass + 1;
    // Numbers of a link.
    static constexpr std::size_t edge = 0, along = D; ///< from a to b; along: at the place of the factorisation
    static constexpr std::size_t length = 2 * D, per_length = length + 1, weight_a = length + 2, weight_b = length + 3;
    static constexpr std::size_t tension = length + 4; ///< multiplier of this substep, h newton seconds; positive pulls
    static constexpr std::size_t active = length + 5;  ///< 1: holds its length; a rope does while it pulls
    static constexpr std::size_t right = length + 6;   ///< right side, then solution
    static constexpr std::size_t pivot = length + 7, of_link = pivot + 1;
    // Numbers of a link, where there are clusters: of its ends in clusters.
    static constexpr std::size_t arm_a = 0, arm_b = spins<D>;            ///< moment of the direction, r x n
    static constexpr std::size_t turn_a = 2 * spins<D>, turn_b = 3 * spins<D>; ///< turn by a unit impulse, I^-1 arm
    static constexpr std::size_t of_ends = 4 * spins<D>;
    // Numbers of a cluster.
    static constexpr std::size_t per_mass = 0, motion = 1, turn = 1 + D; ///< of the whole, in the substep
    static constexpr std::size_t spin = turn + spins<D>;                 ///< inertia times turn
    static constexpr std::size_t push = spin + spins<D>, twist = push + D; ///< motion and turn to be added
    static constexpr std::size_t inverse_inertia = twist + spins<D>;
    static constexpr std::size_t of_cluster = inverse_inertia + (D == 2 ? 1 : 9);
    // Numbers of a member of a cluster, from its centre.
    static constexpr std::size_t rest = 0, now = D, end = 2 * D; ///< at the ends of the substep
    static constexpr std::size_t off = 3 * D, of_member = 4 * D; ///< off: from the particle to its place in the cluster
};

/// Components of equal structure. A field has `stride` numbers, one for each lane: records of the particles, of the
/// links, entries of the factor, energy.
template <int D> struct LinkPack {
    const LinkRow* rows = nullptr;
    std::uint32_t links = 0, particles = 0, entries = 0;
    std::uint32_t count = 0; ///< components
    std::size_t stride = 1;  ///< 1 or max_link_lanes
    bool has_ropes = false;
    const std::uint32_t* slots =
        nullptr;                 ///< of the sweep, `stride` for each particle; unused lanes have those of the first
    const char* moves = nullptr; ///< per particle
    std::uint32_t clusters = 0, members = 0;
    const LinkCluster* ranges = nullptr;        ///< per cluster
    const std::uint32_t* particle_of = nullptr; ///< per member
    double* numbers = nullptr;

    double* of_particle(std::size_t i, std::size_t field) const {
        return numbers + (i * LinkFields<D>::of_particle + field) * stride;
    }
    double* of_link(std::size_t i, std::size_t field) const {
        return of_particle(particles, 0) + (i * LinkFields<D>::of_link + field) * stride;
    }
    double* entry(std::size_t i) const { return of_link(links, 0) + i * stride; }
    double* energy() const { return entry(entries); } ///< due, in its frame, times 2 h^2
    double* of_end(std::size_t link, std::size_t field) const {
        return entry(entries + 1) + (link * LinkFields<D>::of_ends + field) * stride;
    }
    double* of_cluster(std::size_t i, std::size_t field) const {
        return of_end(links, 0) + (i * LinkFields<D>::of_cluster + field) * stride;
    }
    double* of_member(std::size_t i, std::size_t field) const {
        return of_cluster(clusters, 0) + (i * LinkFields<D>::of_member + field) * stride;
    }
    std::size_t size() const {
        using Fields = LinkFields<D>;
        const auto plain = particles * Fields::of_particle + links * Fields::of_link + entries + 1;
        const auto rigid = links * Fields::of_ends + clusters * Fields::of_cluster + members * Fields::of_member;
        return (plain + (clusters > 0 ? rigid : 0)) * stride;
    }
};

/// Columns of the particles (sweep_state.h).
template <int D, class Real> struct LinkColumns {
    const Real* position;
    Real* displacement;
    std::size_t stride; ///< numbers between the columns of two components
    const Real* mobility;
};

/// Kernels of rigid links. `lane`: the only component that takes part, or -1 for all.
template <int D, class Real> struct LinkKernels {
    using Project = void (*)(const LinkColumns<D, Real>&, const LinkPack<D>&, int lane);
    Project factorise;  ///< at the present places
    Project weigh;      ///< `factorise` where a mobility has changed
    Project velocities; ///< no link is about to change its length, to first order
    Project lengths;    ///< right lengths at the end of the displacements
    Project again;      ///< `lengths` once more: the energy due stays as it was
    Project restore;    ///< after the particles have moved: velocities, with no more energy than before `lengths`
};

} // namespace sinew

#pragma once

#include "sinew/math/moments.h"

#include <array>
#include <cstddef>
#include <cstdint>

/// Components of rigid links side by side in the lanes of packs, a component to a lane.
namespace sinew {

/// Most components of a pack.
inline constexpr std::size_t max_link_lanes = 8;

/// Link of a component, and its row in the skyline of G M^-1 G^T. Particles, clusters and links are numbered within the
/// component.
struct LinkRow {
    static constexpr std::uint32_t none = ~std::uint32_t(0);
    std::uint32_t a = 0, b = 0;                       ///< particles
    std::uint32_t cluster_a = none, cluster_b = none; ///< of the particles
    std::uint32_t first = 0;                          ///< first column
    std::uint32_t start = 0;                          ///< first entry
    std::uint32_t is_rope = 0;                        ///< may be shorter than its length
    std::uint32_t moves = 0;                          ///< bits: a can move, b can move
    friend constexpr bool operator==(const LinkRow&, const LinkRow&) = default;
};

/// Rigid cluster: a range of LinkPack::members.
struct LinkCluster {
    std::uint32_t first = 0, last = 0;
    friend constexpr bool operator==(const LinkCluster&, const LinkCluster&) = default;
};

/// Motion of a rigid cluster while rows of contact act on it.
template <int D, class Real> struct ClusterMotion {
    using Vector = Vec<D, Real>;
    using Spin = Vec<spins<D>, Real>;
    static constexpr std::size_t inertias = spins<D> * (spins<D> + 1) / 2;
    Vector centre{};                          ///< of mass, at the present places
    Vector move{};                            ///< displacement of the centre
    Spin turn{};                              ///< radians
    Real per_mass = 0;                        ///< 1 / kg
    std::array<Real, inertias> per_inertia{}; ///< upper triangle, in rows; 1 / (kg m^2)

    Spin turned_by(const Spin& moment) const {
        const auto& m = per_inertia;
        if constexpr (D == 2)
            return moment * m[0];
        else
            return {{m[0] * moment[0] + m[1] * moment[1] + m[2] * moment[2],
                     m[1] * moment[0] + m[3] * moment[1] + m[4] * moment[2],
                     m[2] * moment[0] + m[4] * moment[1] + m[5] * moment[2]}};
    }
};

/// Fields of the records of a pack.
template <int D> struct LinkFields {
    static constexpr std::size_t spins = D == 2 ? 1 : 3, inertias = D == 2 ? 1 : 9;
    // Numbers of a particle.
    static constexpr std::size_t displacement = 0, before = D; ///< before: the lengths were corrected
    static constexpr std::size_t added = 2 * D;                ///< correction
    static constexpr std::size_t mobility = 3 * D, mass = mobility + 1;
    // Numbers of a member of a cluster, zero in other particles.
    static constexpr std::size_t arm = mass + 1;  ///< from the centre of mass, in the cluster's pose
    static constexpr std::size_t off = arm + D;   ///< from the position to the place in that pose
    static constexpr std::size_t held = off + D;  ///< displacement by the links of the cluster in this substep
    static constexpr std::size_t rest = held + D; ///< place in the frame of the cluster
    static constexpr std::size_t of_particle = rest + D;
    // Numbers of a cluster.
    static constexpr std::size_t move = 0, turn = D; ///< displacement of the centre; rotation, radians
    static constexpr std::size_t added_move = turn + spins, added_turn = added_move + D;
    static constexpr std::size_t per_mass = added_turn + spins;
    static constexpr std::size_t centre = per_mass + 1;    ///< of mass, in its frame
    static constexpr std::size_t rotation = centre + D;    ///< of the frame, in rows
    static constexpr std::size_t taken = rotation + D * D; ///< rotation at the place of the factorisation
    static constexpr std::size_t inertia = taken + D * D, per_inertia = inertia + inertias;
    static constexpr std::size_t of_cluster = per_inertia + inertias;
    // Numbers of a link.
    static constexpr std::size_t edge = 0, along = D; ///< from a to b; along: direction in which it pulls
    static constexpr std::size_t factored = 2 * D;    ///< `along` at the place of the factorisation
    static constexpr std::size_t length = 3 * D, per_length = length + 1;
    static constexpr std::size_t weight_a = length + 2,
                                 weight_b = length + 3; ///< inverse masses of the ends or clusters
    static constexpr std::size_t tension = length + 4; ///< multiplier of this substep, h newton seconds; positive pulls
    static constexpr std::size_t active = length + 5;  ///< 1: holds its length; a rope does while it pulls
    static constexpr std::size_t right = length + 6;   ///< right side, then solution
    static constexpr std::size_t pivot = length + 7;
    static constexpr std::size_t lever_a = pivot + 1, lever_b = lever_a + spins; ///< moments of `along` at the ends
    static constexpr std::size_t turned_a = lever_b + spins,
                                 turned_b = turned_a + spins; ///< rotations by these moments
    static constexpr std::size_t of_link = turned_b + spins;
};

/// Components of equal structure. A field has `stride` numbers, one for each lane: records of the particles, of the
/// links, of the clusters, entries of the factor, energies and the angle.
template <int D> struct LinkPack {
    static constexpr char moves_alone = 1, moves_with_cluster = 2;
    static constexpr double no_energy = -1e300; ///< none is due
    const LinkRow* rows = nullptr;
    const LinkCluster* cluster = nullptr;
    const std::uint32_t* members = nullptr; ///< particles of the clusters
    std::uint32_t links = 0, clusters = 0, particles = 0, entries = 0;
    std::uint32_t count = 0;                                   ///< components
    std::array<std::uint32_t, max_link_lanes> first_cluster{}; ///< of the component in each lane, among all
    std::size_t stride = 1;                                    ///< 1 or max_link_lanes
    bool has_ropes = false;
    bool notes_held = false; ///< LinkFields::held is of interest
    const std::uint32_t* slots =
        nullptr;                 ///< of the sweep, `stride` for each particle; unused lanes have those of the first
    const char* moves = nullptr; ///< per particle: 0, or `moves_alone`, or `moves_with_cluster`
    double* numbers = nullptr;

    double* of_particle(std::size_t i, std::size_t field) const {
        return numbers + (i * LinkFields<D>::of_particle + field) * stride;
    }
    double* of_link(std::size_t i, std::size_t field) const {
        return of_particle(particles, 0) + (i * LinkFields<D>::of_link + field) * stride;
    }
    double* of_cluster(std::size_t i, std::size_t field) const {
        return of_link(links, 0) + (i * LinkFields<D>::of_cluster + field) * stride;
    }
    double* entry(std::size_t i) const { return of_cluster(clusters, 0) + i * stride; }
    double* energy() const { return entry(entries); }           ///< due, in its frame, times 2 h^2: at most
    double* least_energy() const { return entry(entries + 1); } ///< without the work of gravity
    double* may_turn() const { return entry(entries + 2); }     ///< the links until the next factorisation, radians
    std::size_t size() const {
        using Fields = LinkFields<D>;
        return (particles * Fields::of_particle + links * Fields::of_link + clusters * Fields::of_cluster + entries +
                3) *
               stride;
    }
};

/// Columns of the particles (sweep_state.h).
template <int D, class Real> struct LinkColumns {
    const Real* position;
    Real* displacement;
    std::size_t stride; ///< numbers between the columns of two components
    const Real* mobility;
    ClusterMotion<D, Real>* motions; ///< of all clusters
    double furthest;                 ///< displacement of a substep
    Vec<D, double> fall;             ///< gravity times the square of the substep
    bool only_falls;                 ///< no other force acts
};

/// Kernels of rigid links. `lane`: the only component that takes part, or -1 for all.
template <int D, class Real> struct LinkKernels {
    using Project = void (*)(const LinkColumns<D, Real>&, const LinkPack<D>&, int lane);
    Project factorise;  ///< at the present places
    Project note;       ///< the energy due at least, before contacts act or after blows
    Project velocities; ///< no link is about to change its length, to first order
    Project begin_rows; ///< shows the motions of clusters, for rows that act on them
    Project end_rows;   ///< `velocities`, with these motions as rows have changed them
    Project lengths;    ///< right lengths at the end of the displacements
    Project again;      ///< `lengths` once more: the energy due stays as it was
    Project restore;    ///< after the particles have moved: velocities, with the energy due
};

} // namespace sinew

#pragma once

#include "sinew/solver/simd/link_clusters.h"

namespace sinew {
namespace {

/// Solutions of the links of the components in the lanes of V: applied to the particles, with ropes that pull only by
/// an active set. A component that is not in the mask of a function stays as it is.
template <int D, class V> class LinkSolution : protected LinkClusters<D, V> {
  protected:
    using Clusters = LinkClusters<D, V>;
    using Lanes = LinkLanes<D, V>;
    using Fields = LinkFields<D>;
    using Clusters::blend, Clusters::norm, Clusters::pull, Clusters::note_pull;
    using Lanes::number, Lanes::inverse_or_zero, Lanes::link, Lanes::set_link, Lanes::particle, Lanes::pack_;
    using Lanes::particle_vector, Lanes::set_particle_vector, Lanes::link_vector;
    using typename Clusters::Mask, typename Clusters::Vector;
    static constexpr std::size_t width = sizeof(V) / sizeof(double);
    static constexpr double slight = 1e-9; ///< change of a link that counts as none, as a share of its length

    using Clusters::Clusters;

    static Mask either(const Mask& a, const Mask& b) {
        if constexpr (width == 1)
            return a || b;
        else
            return a | b;
    }
    Vector displacement(std::size_t i) const { return particle_vector(i, Fields::displacement); }
    Vector between(const LinkRow& row) const { return displacement(row.b) - displacement(row.a); }
    template <class Visit> void each_link(Visit&& visit) const {
        for (std::uint32_t k = 0; k < pack_.links; ++k) visit(k, pack_.rows[k]);
    }

    // --- solutions ---------------------------------------------------------------------------------------------------

    [[gnu::flatten, gnu::noinline]] void apply(const Mask& mask) const {
        const LinkSolution here = *this;
        here.apply_here(mask);
    }
    [[gnu::always_inline]] void apply_here(const Mask mask) const {
        each_link([&](std::uint32_t k, const LinkRow& row) {
            const V right = mask ? link(k, Fields::right) : V{};
            set_link(k, Fields::tension, link(k, Fields::tension) + right);
            pull(k, row, right, Fields::displacement, Fields::move, Fields::turn);
            note_pull(k, row, right);
        });
    }
    /// Applies at most such a share of the solution that no link changes by more than `max_change` of its length.
    /// `searches`: where the whole of that leaves a large part of the errors, the best of it, a half and a quarter: the
    /// links of a light chain that snaps taut under a heavy weight would fold to and fro.
    [[gnu::flatten, gnu::noinline]] void apply_within(const Mask& mask, bool searches) const {
        const LinkSolution here = *this;
        here.apply_within_here(mask, searches);
    }
    [[gnu::always_inline]] void apply_within_here(const Mask mask, bool searches) const {
        constexpr double max_change = 0.2;
        Clusters::clear_added();
        each_link([&](std::uint32_t k, const LinkRow& row) {
            pull(k, row, link(k, Fields::right), Fields::added, Fields::added_move, Fields::added_turn);
        });
        V largest{};
        each_link([&](std::uint32_t k, const LinkRow& row) {
            largest = lane::max(largest, norm(added_between(row)) * link(k, Fields::per_length));
        });
        V share = largest > number(max_change) ? number(max_change) / largest : number(1);
        if (searches) share = best_of(share);
        share = mask ? share : V{};
        each_link([&](std::uint32_t k, const LinkRow& row) {
            const V right = link(k, Fields::right) * share;
            set_link(k, Fields::tension, link(k, Fields::tension) + right);
            note_pull(k, row, right);
        });
        for (std::size_t i = 0; i < pack_.particles; ++i)
            set_particle_vector(i, Fields::displacement, displacement(i) + particle_vector(i, Fields::added) * share);
        Clusters::add(share);
    }
    V best_of(const V& share) const {
        constexpr double much = 0.25; // of the squares
        const V half = share * number(0.5), quarter = share * number(0.25);
        const V left = errors_after(share), of_half = errors_after(half), of_quarter = errors_after(quarter);
        const V less = of_quarter < of_half ? quarter : half;
        const V best = lane::min(of_half, of_quarter) < left ? less : share;
        return left > errors_after(V{}) * number(much) ? best : share;
    }
    /// Sum of the squares of the relative errors of the lengths, after a share of the solution.
    V errors_after(const V& share) const {
        V sum{};
        each_link([&](std::uint32_t k, const LinkRow& row) {
            const Vector edge = link_vector(k, Fields::edge) + between(row) + added_between(row) * share;
            const V error = (norm(edge) * link(k, Fields::per_length) - number(1)) * link(k, Fields::active);
            sum = sum + error * error;
        });
        return sum;
    }
    Vector added_between(const LinkRow& row) const {
        return added_at(row.b, row.cluster_b) - added_at(row.a, row.cluster_a);
    }
    Vector added_at(std::uint32_t i, std::uint32_t c) const {
        return c == LinkRow::none ? particle_vector(i, Fields::added) : Clusters::added_at(i, c);
    }

    // --- ropes -------------------------------------------------------------------------------------------------------

    /// Lets go the rows that would push. Lanes in which any did.
    Mask release(const Mask& mask) const {
        if (!pack_.has_ropes) return lane::without(mask, mask);
        V any{};
        each_link([&](std::uint32_t k, const LinkRow& row) {
            if (row.is_rope == 0) return;
            const V active = link(k, Fields::active);
            const V tension = link(k, Fields::tension) + link(k, Fields::right) * number(1 + slight);
            const Mask pushes = lane::both(mask, lane::both(active > V{}, tension < V{}));
            set_link(k, Fields::active, pushes ? V{} : active);
            any = pushes ? number(1) : any;
        });
        return factorise_where(any > V{});
    }
    /// Takes hold of the ropes that `pulls` says are taut. Lanes with any.
    template <class Pulls> Mask activate(const Mask& mask, Pulls&& pulls) const {
        if (!pack_.has_ropes) return lane::without(mask, mask);
        V any{};
        each_link([&](std::uint32_t k, const LinkRow& row) {
            if (row.is_rope == 0) return;
            const V active = link(k, Fields::active);
            const Mask taken = lane::both(lane::both(mask, active <= V{}), pulls(k, row));
            set_link(k, Fields::active, taken ? number(1) : active);
            any = taken ? number(1) : any;
        });
        return factorise_where(any > V{});
    }
    Mask factorise_where(const Mask& mask) const {
        if (lane::any(mask)) Clusters::factorise(mask);
        return mask;
    }

    // --- energy ------------------------------------------------------------------------------------------------------

    /// Displacement in which the energy is measured: of the first particle that cannot move, or the mean.
    [[gnu::flatten, gnu::noinline]] Vector frame() const {
        const LinkSolution here = *this;
        return here.frame_here();
    }
    [[gnu::always_inline]] Vector frame_here() const {
        Vector frame{};
        V mass{};
        for (std::size_t i = 0; i < pack_.particles; ++i) {
            const V own = particle(i, Fields::mass);
            mass = mass + own, frame = frame + displacement(i) * own;
        }
        frame = frame * inverse_or_zero(mass);
        for (std::size_t i = pack_.particles; i-- > 0;) {
            const Mask stands = particle(i, Fields::mobility) <= V{};
            if (lane::any(stands)) frame = blend(stands, displacement(i), frame);
        }
        return frame;
    }
    /// Kinetic energy in that frame, times 2 h^2.
    [[gnu::flatten, gnu::noinline]] V energy_in(const Vector& frame) const {
        const LinkSolution here = *this;
        return here.energy_here(frame);
    }
    [[gnu::always_inline]] V energy_here(const Vector frame) const {
        V sum{};
        for (std::size_t i = 0; i < pack_.particles; ++i) {
            const Vector own = displacement(i) - frame;
            sum = sum + particle(i, Fields::mass) * dot(own, own);
        }
        return sum;
    }
};

} // namespace
} // namespace sinew

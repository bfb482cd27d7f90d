#pragma once

#include "sinew/solver/simd/link_clusters.h"

namespace sinew {
namespace {

/// Solutions of the links of the components in the lanes of V: applied to the particles, with ropes that pull only by
/// an active set. A component that is not in the mask of a function stays as it is.
template <int D, class V> class LinkSolution : protected LinkClusters<D, V> {
  protected:
    using Lanes = LinkClusters<D, V>;
    using Fields = LinkFields<D>;
    using Lanes::number, Lanes::inverse_or_zero, Lanes::link, Lanes::set_link, Lanes::particle, Lanes::pack_;
    using Lanes::particle_vector, Lanes::set_particle_vector, Lanes::link_vector;
    using Lanes::blend, Lanes::displacement;
    using typename Lanes::Mask, typename Lanes::Vector;
    static constexpr std::size_t width = sizeof(V) / sizeof(double);
    static constexpr double slight = 1e-9; ///< change of a link that counts as none, as a share of its length

    using Lanes::Lanes;

    static Mask either(const Mask& a, const Mask& b) {
        if constexpr (width == 1)
            return a || b;
        else
            return a | b;
    }
    Vector between(const LinkRow& row) const { return displacement(row.b) - displacement(row.a); }
    static V norm(const Vector& v) { return lane::root(dot(v, v)); }
    template <class Visit> void each_link(Visit&& visit) const {
        for (std::uint32_t k = 0; k < pack_.links; ++k) visit(k, pack_.rows[k]);
    }

    // --- solutions ---------------------------------------------------------------------------------------------------

    [[gnu::flatten, gnu::noinline]] void apply(const Mask& mask) const {
        const LinkSolution here = *this;
        here.apply_here(mask);
    }
    [[gnu::always_inline]] void apply_here(const Mask mask) const {
        if (pack_.clusters > 0) return apply_by_clusters(mask);
        each_link([&](std::uint32_t k, const LinkRow& row) {
            const V right = mask ? link(k, Fields::right) : V{};
            const Vector along = link_vector(k, Fields::along);
            set_link(k, Fields::tension, link(k, Fields::tension) + right);
            set_particle_vector(row.a, Fields::displacement,
                                displacement(row.a) + along * (right * link(k, Fields::weight_a)));
            set_particle_vector(row.b, Fields::displacement,
                                displacement(row.b) - along * (right * link(k, Fields::weight_b)));
        });
    }
    void apply_by_clusters(const Mask& mask) const {
        Lanes::clear_pushes();
        each_link([&](std::uint32_t k, const LinkRow& row) {
            const V right = mask ? link(k, Fields::right) : V{};
            const Vector along = link_vector(k, Fields::along);
            set_link(k, Fields::tension, link(k, Fields::tension) + right);
            if (row.cluster_a == no_member)
                set_particle_vector(row.a, Fields::displacement,
                                    displacement(row.a) + along * (right * link(k, Fields::weight_a)));
            if (row.cluster_b == no_member)
                set_particle_vector(row.b, Fields::displacement,
                                    displacement(row.b) - along * (right * link(k, Fields::weight_b)));
            Lanes::push_ends(k, row, right);
        });
        Lanes::add_pushes();
    }
    /// Applies at most such a share of the solution that no link changes by more than `max_change` of its length.
    [[gnu::flatten, gnu::noinline]] void apply_within(const Mask& mask) const {
        const LinkSolution here = *this;
        here.apply_within_here(mask);
    }
    [[gnu::always_inline]] void apply_within_here(const Mask mask) const {
        constexpr double max_change = 0.2;
        for (std::size_t i = 0; i < pack_.particles; ++i) set_particle_vector(i, Fields::added, Vector{});
        each_link([&](std::uint32_t k, const LinkRow& row) {
            const Vector along = link_vector(k, Fields::along);
            const V right = link(k, Fields::right);
            set_particle_vector(row.a, Fields::added,
                                particle_vector(row.a, Fields::added) + along * (right * link(k, Fields::weight_a)));
            set_particle_vector(row.b, Fields::added,
                                particle_vector(row.b, Fields::added) - along * (right * link(k, Fields::weight_b)));
        });
        if (pack_.clusters > 0) add_by_clusters();
        V largest{};
        each_link([&](std::uint32_t k, const LinkRow& row) {
            const Vector change = particle_vector(row.b, Fields::added) - particle_vector(row.a, Fields::added);
            largest = lane::max(largest, norm(change) * link(k, Fields::per_length));
        });
        V share = largest > number(max_change) ? number(max_change) / largest : number(1);
        share = mask ? share : V{};
        each_link([&](std::uint32_t k, const LinkRow&) {
            set_link(k, Fields::tension, link(k, Fields::tension) + link(k, Fields::right) * share);
        });
        for (std::size_t i = 0; i < pack_.particles; ++i)
            set_particle_vector(i, Fields::displacement, displacement(i) + particle_vector(i, Fields::added) * share);
        if (pack_.clusters > 0) Lanes::move_clusters(share);
    }
    /// Members are added what their clusters are.
    void add_by_clusters() const {
        Lanes::clear_pushes();
        each_link([&](std::uint32_t k, const LinkRow& row) { Lanes::push_ends(k, row, link(k, Fields::right)); });
        Lanes::each_cluster([&](std::size_t i) {
            Lanes::each_member(i, [&](std::size_t k, std::size_t p) {
                set_particle_vector(p, Fields::added, Lanes::pushed(i, k, Fields::end));
            });
        });
    }

    // --- ropes -------------------------------------------------------------------------------------------------------

    /// Lets go what would push. Lanes in which anything did.
    Mask release(const Mask& mask) const {
        if (!pack_.has_ropes) return lane::without(mask, mask);
        V any{};
        each_link([&](std::uint32_t k, const LinkRow& row) {
            if (row.is_rope == 0) return;
            const V active = link(k, Fields::active);
            const V pull = link(k, Fields::tension) + link(k, Fields::right) * number(1 + slight);
            const Mask pushes = lane::both(mask, lane::both(active > V{}, pull < V{}));
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
    /// Lanes in which nothing has changed receive the same factor again.
    Mask factorise_where(const Mask& mask) const {
        if (lane::any(mask)) Lanes::factorise();
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
    /// Slows motion down to the energy due where rows held between corrections of lengths (`again`) have gained some.
    void slow_down(const Mask& gains, const V& due) const {
        if (!lane::any(gains)) return;
        const Vector drift = frame();
        const V share = lane::root(V(due * inverse_or_zero(energy_in(drift))));
        for (std::size_t i = 0; i < pack_.particles; ++i) {
            const Vector moved = displacement(i);
            set_particle_vector(i, Fields::displacement, blend(gains, drift + (moved - drift) * share, moved));
        }
    }
};

} // namespace
} // namespace sinew

#pragma once

#include "sinew/solver/simd/link_energy.h"

/// Kernels of rigid links (contact/link_projector.h).
namespace sinew {
namespace {

/// Projections of the components in the lanes of V. A component that is not in the mask of a function stays as it is.
template <int D, class Real, class V> class LinkProjection : LinkEnergy<D, Real, V> {
    using Energy = LinkEnergy<D, Real, V>;
    using Exchange = LinkExchange<D, Real, V>;
    using Solution = LinkSolution<D, V>;
    using Fields = LinkFields<D>;
    using Clusters = typename Solution::Clusters;
    using Exchange::columns_, Exchange::gather, Exchange::load, Exchange::store;
    using Solution::activate, Solution::apply, Solution::apply_within, Solution::release;
    using Solution::between, Solution::blend, Solution::displacement, Solution::each_link, Solution::norm;
    using Solution::energy_in, Solution::frame, Solution::slight, Solution::width;
    using Solution::may_turn, Solution::pack_, Solution::set_particle;
    using Solution::number, Solution::inverse_or_zero, Solution::link, Solution::set_link, Solution::particle;
    using Solution::particle_vector, Solution::set_particle_vector, Solution::link_vector, Solution::set_link_vector;
    using typename Solution::Mask, typename Solution::Vector;

  public:
    LinkProjection(const LinkColumns<D, Real>& columns, const LinkPack<D>& pack, std::size_t first_lane, int only)
        : Energy(columns, pack, first_lane, only), live_(Exchange::lanes_in_use()) {}

    void factorise() {
        for (std::uint32_t i = 0; i < pack_.particles; ++i) {
            const V mobility = gather(columns_.mobility, i);
            set_particle(i, Fields::mobility, mobility);
            set_particle(i, Fields::mass, inverse_or_zero(mobility));
        }
        Clusters::find_centres();
        measure();
        take_directions(live_);
        Clusters::factorise(live_);
    }
    void note() {
        load();
        Solution::set_least_energy(live_ ? Energy::with_fall() : Solution::least_energy());
    }
    void velocities() {
        load();
        project_velocities(live_);
        store();
    }
    void begin_rows() {
        if (pack_.clusters == 0) return;
        load();
        Clusters::make_rigid(live_);
        if (pack_.notes_held) store(); // rows push members, too
        Exchange::show_motions();
    }
    void end_rows() {
        if (pack_.clusters > 0) Exchange::take_motions();
        load(pack_.clusters == 0 || pack_.notes_held ? char(-1) : LinkPack<D>::moves_with_cluster);
        hold_links_of_clusters(live_);
        store();
    }
    void lengths() {
        load();
        Clusters::make_rigid(live_);
        Solution::set_energy(energy_in(frame()));
        Solution::set_least_energy(lane::min(Energy::with_fall(), Solution::least_energy()));
        correct_lengths();
    }
    void lengths_again() {
        Energy::load_shortened(live_);
        Clusters::make_rigid(live_);
        correct_lengths();
    }
    void restore() {
        const Mask changed = lane::both(live_, measure());
        take_directions(live_);
        if (lane::any(changed)) Clusters::factorise(changed);
        Energy::load_shortened(live_);
        const V work = Energy::fall() * number(2);
        project_velocities(live_);
        Energy::add_work(work - Energy::fall());
        restore_energy();
        store();
    }

  private:
    static constexpr int max_rounds = 8;
    static constexpr double taut = 1 - 1e-4; ///< share of its length at which a rope may begin to pull

    Mask live_;

    // --- directions --------------------------------------------------------------------------------------------------

    /// Edges at the present places. A rope shorter than the share `taut` of its length lets go. Lanes in which that
    /// happened, or a link has turned since the directions were taken.
    [[gnu::flatten, gnu::noinline]] Mask measure() const {
        const LinkProjection here = *this;
        return here.measure_here();
    }
    [[gnu::always_inline]] Mask measure_here() const {
        Vector at[2];
        V changed{};
        if (pack_.clusters > 0) changed = pose_changed() ? number(1) : changed;
        each_link([&](std::uint32_t k, const LinkRow& row) {
            for (std::size_t c = 0; c < D; ++c) {
                const Real* const column = columns_.position + c * columns_.stride;
                at[0].at[c] = gather(column, row.a), at[1].at[c] = gather(column, row.b);
            }
            const Vector edge = at[1] - at[0];
            set_link_vector(k, Fields::edge, edge);
            const V length = norm(edge), off_by = length * may_turn();
            const Vector off = edge - link_vector(k, Fields::factored) * length;
            changed = off_by * off_by < dot(off, off) ? number(1) : changed;
            if (row.is_rope == 0) return;
            const V active = link(k, Fields::active);
            const Mask lets_go = lane::both(active > V{}, length < number(taut) * link(k, Fields::length));
            set_link(k, Fields::active, lets_go ? V{} : active);
            changed = lets_go ? number(1) : changed;
        });
        return changed > V{};
    }
    [[gnu::flatten, gnu::noinline]] Mask pose_changed() const {
        const LinkProjection here = *this;
        here.find_poses([&](std::uint32_t i) {
            Vector at;
            for (std::size_t c = 0; c < D; ++c) at.at[c] = here.gather(columns_.position + c * columns_.stride, i);
            return at;
        });
        return here.have_turned(here.may_turn());
    }
    /// Directions of the edges, and inverse masses.
    [[gnu::flatten, gnu::noinline]] void take_directions(const Mask& mask) const {
        const auto weight_of = [&](std::uint32_t i, std::uint32_t c) {
            return c == LinkRow::none ? particle(i, Fields::mobility) : Solution::cluster(c, Fields::per_mass);
        };
        each_link([&](std::uint32_t k, const LinkRow& row) {
            const Vector edge = link_vector(k, Fields::edge);
            set_link_vector(k, Fields::along,
                            blend(mask, edge * inverse_or_zero(norm(edge)), link_vector(k, Fields::along)));
            set_link(k, Fields::weight_a, weight_of(row.a, row.cluster_a));
            set_link(k, Fields::weight_b, weight_of(row.b, row.cluster_b));
            Clusters::take_levers(k, row, mask);
        });
    }
    void turn_gradients(const Mask& mask) const {
        each_link([&](std::uint32_t k, const LinkRow& row) {
            const Vector edge = link_vector(k, Fields::edge) + between(row);
            set_link_vector(k, Fields::along,
                            blend(mask, edge * inverse_or_zero(norm(edge)), link_vector(k, Fields::along)));
            Clusters::take_levers(k, row, mask, true);
        });
        Clusters::factorise(mask);
    }

    // --- projections -------------------------------------------------------------------------------------------------

    [[gnu::flatten, gnu::noinline]] void take_rates() const {
        const LinkProjection here = *this;
        here.take_rates_here();
    }
    [[gnu::always_inline]] void take_rates_here() const {
        each_link([&](std::uint32_t k, const LinkRow& row) {
            set_link(k, Fields::right, Clusters::rate(k, row) * link(k, Fields::active));
        });
    }
    void project_velocities(const Mask& live) const {
        Clusters::make_rigid(live);
        if (pack_.links == 0) return;
        hold_links(live);
        Clusters::spread(live, Fields::move, Fields::turn);
    }
    void hold_links_of_clusters(const Mask& live) const {
        if (pack_.links > 0) hold_links(live);
        Clusters::spread(live, Fields::move, Fields::turn);
    }
    [[gnu::flatten, gnu::noinline]] void hold_links(Mask live) const {
        for (int i = 0; i < max_rounds; ++i) {
            take_rates();
            Solution::solve();
            if (!pack_.has_ropes) return apply(live);
            const Mask released = i + 1 < max_rounds ? release(live) : lane::without(live, live);
            const Mask applied = lane::without(live, released);
            apply(applied);
            live = Solution::either(released, activate(applied, [&](std::uint32_t k, const LinkRow& row) {
                                        const V length = link(k, Fields::length);
                                        return lane::both(norm(link_vector(k, Fields::edge)) >= length * number(taut),
                                                          Clusters::rate(k, row) > length * number(slight));
                                    }));
            if (!lane::any(live)) return;
        }
    }

    void correct_lengths() {
        for (std::uint32_t i = 0; i < pack_.particles; ++i)
            set_particle_vector(i, Fields::before, blend(live_, displacement(i), particle_vector(i, Fields::before)));
        Clusters::pose(live_);
        const Mask turned = project_lengths();
        if (lane::any(turned)) Energy::turn_back(turned);
        store();
    }
    V excess(std::uint32_t k, const LinkRow& row) const {
        return norm(link_vector(k, Fields::edge) + between(row)) - link(k, Fields::length);
    }
    /// One step along the gradients at the start leaves an error of second order, the next of third. Where a few do not
    /// suffice, the gradients are those at the end: they always correct. Steps far beyond the linear model are cut
    /// short. Returns the lanes of such gradients, which do not keep the angular momentum.
    [[gnu::flatten, gnu::noinline]] Mask project_lengths() const {
        constexpr double exact = sizeof(Real) == sizeof(float) ? 1e-6 : 1e-9;
        constexpr int first_rounds = 2, usual_rounds = 4, all_rounds = 24;
        Mask live = live_, turned = lane::without(live, live);
        for (int i = 0; i < all_rounds; ++i) {
            if (i >= usual_rounds) {
                turned = Solution::either(turned, live);
                turn_gradients(live);
            }
            activate(live, [&](std::uint32_t k, const LinkRow& row) {
                return excess(k, row) > link(k, Fields::length) * number(exact);
            });
            V worst{};
            each_link([&](std::uint32_t k, const LinkRow& row) {
                const V right = excess(k, row) * link(k, Fields::active);
                set_link(k, Fields::right, right);
                worst = lane::max(worst, lane::size_of(right) * link(k, Fields::per_length));
            });
            live = lane::both(live, worst > number(exact));
            if (!lane::any(live)) break;
            Solution::solve();
            const Mask released = i + 1 < all_rounds ? release(live) : lane::without(live, live);
            const Mask applied = lane::without(live, released);
            apply_within(applied, i >= first_rounds);
            Clusters::pose(applied);
        }
        return turned;
    }

    // --- energy ------------------------------------------------------------------------------------------------------

    /// Links do no work: the velocities have the energy from before the lengths were corrected, without pushes out of
    /// overlaps. A rope that snaps taut may lose some.
    [[gnu::flatten, gnu::noinline]] void restore_energy() const {
        constexpr double much = 1.001;
        const Vector drift = frame();
        const V most = Solution::energy(), least = Solution::least_energy(), now = energy_in(drift);
        const Mask gains = lane::both(live_, now > most), off = Solution::either(gains, lane::both(live_, now < least));
        if (!lane::any(off)) return;
        const typename Energy::Body body(*this);
        const Mask gains_much = lane::both(gains, now > most * number(much));
        if (lane::any(gains_much)) {
            const auto spin = body.spin();
            for (std::size_t i = 0; i < pack_.particles; ++i)
                set_particle_vector(i, Fields::displacement,
                                    blend(gains_much, particle_vector(i, Fields::before), displacement(i)));
            project_velocities(gains_much);
            Energy::set_momenta(lane::both(gains_much, now > body.rounding()), body, drift, spin);
        }
        const V left = energy_in(frame());
        Energy::scale(lane::both(off, left > most), body, most);
        Energy::scale(lane::both(off, left < least), body, least);
    }
};

/// Calls work(projection) for the lanes of a pack, or for those around one lane.
template <int D, class Real, class Work>
void each_lane(const LinkColumns<D, Real>& columns, const LinkPack<D>& pack, int only, const Work& work) {
    if (pack.stride == 1) {
        LinkProjection<D, Real, double> projection(columns, pack, 0, only);
        return work(projection);
    }
    constexpr int width = lane::widest<double>;
    for (int first = 0; first < int(pack.count); first += width) {
        if (only >= 0 && (only < first || only >= first + width)) continue;
        LinkProjection<D, Real, lane::Pack<double, width>> projection(columns, pack, std::size_t(first), only);
        work(projection);
    }
}

template <int D, class Real> constexpr LinkKernels<D, Real> link_kernels() {
    const auto kernel = [](auto work) {
        return [](const LinkColumns<D, Real>& columns, const LinkPack<D>& pack, int only) {
            each_lane(columns, pack, only, decltype(work){});
        };
    };
    return {.factorise = kernel([](auto& projection) { projection.factorise(); }),
            .note = kernel([](auto& projection) { projection.note(); }),
            .velocities = kernel([](auto& projection) { projection.velocities(); }),
            .begin_rows = kernel([](auto& projection) { projection.begin_rows(); }),
            .end_rows = kernel([](auto& projection) { projection.end_rows(); }),
            .lengths = kernel([](auto& projection) { projection.lengths(); }),
            .again = kernel([](auto& projection) { projection.lengths_again(); }),
            .restore = kernel([](auto& projection) { projection.restore(); })};
}

} // namespace
} // namespace sinew

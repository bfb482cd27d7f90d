#pragma once

#include "sinew/math/matrix.h"
#include "sinew/solver/contact/link_packs.h"
#include "sinew/solver/simd/link_clusters.h"

namespace sinew::detail {

/// Displacements of particles for impulses on them, with the lengths of their components held.
template <int D, class Real> class LinkResponse {
  public:
    using Vector = Vec<D, double>;
    using Matrix = sinew::Matrix<D, double>;

    LinkResponse(const RigidLinks<D, Real>& links, const LinkPacks<D, Real>& packs, const SweepState<D, Real>& state)
        : links_(links), packs_(packs), state_(state) {}

    /// Displacement of a particle for an impulse on it: a symmetric matrix, 1 / kg.
    Matrix of(Row slot) const {
        auto matrix = Matrix::diagonal(double(state_.mobility[slot]));
        if (links_.component_of[slot] == none) return matrix;
        const auto lane = lane_of(links_.component_of[slot]);
        for (int i = 0; i < D; ++i) {
            const auto push = Vector::axis(i);
            const Pushes one{std::span(&slot, 1), std::span(&push, 1)};
            lane.solve(one);
            matrix.column[std::size_t(i)] = lane.displacement_of(slot, push * double(state_.mobility[slot]));
        }
        return matrix;
    }
    /// Displacement, along the pushes, for a unit of these pushes on particles, 1 / kg.
    double along(std::span<const Row> slots, std::span<const Vector> pushes) const {
        double sum = 0;
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (links_.clusters.cluster_of(slots[i]) == none)
                sum += double(state_.mobility[slots[i]]) * dot(pushes[i], pushes[i]);
            if (is_first_of_component(slots, i))
                sum += lane_of(links_.component_of[slots[i]]).solve({slots, pushes});
        }
        return max(sum, 0.0);
    }

    /// Moves the particles by a multiple of the displacement for which `along` has last been asked.
    void move(SweepState<D, Real>& state, std::span<const Row> slots, std::span<const Vector> pushes,
              double impulse) const {
        const Real furthest = max_displacement(Real(1) / state.per_h);
        const auto add = [&](Row slot, const Vector& moved) {
            const auto to = state.displacement_at(slot) + cast<Real>(moved * impulse);
            state.set_displacement(slot, clamp_components(to, furthest));
        };
        for (std::size_t i = 0; i < slots.size(); ++i)
            if (const double mobility = double(state.mobility[slots[i]]);
                mobility > 0 && links_.clusters.cluster_of(slots[i]) == none)
                add(slots[i], pushes[i] * mobility);
        for (std::size_t i = 0; i < slots.size(); ++i)
            if (is_first_of_component(slots, i)) lane_of(links_.component_of[slots[i]]).each_displacement(add);
    }
    /// Holds the lengths of a component as they change at the end of the displacements, from now on in the substep. A
    /// straight rope gives way across it, and is stiff once it is bent.
    void turn(std::uint32_t component) const {
        const auto lane = lane_of(component);
        lane.each_link([&](std::uint32_t k) {
            const auto [a, b] = lane.ends(k);
            const auto edge = cast<double>(state_.position_at(b) - state_.position_at(a)) +
                              cast<double>(state_.displacement_at(b) - state_.displacement_at(a));
            lane.set_along(k, edge * inverse_or_zero(norm(edge)));
        });
        lane.factorise();
    }

  private:
    static constexpr auto none = RigidLinks<D, Real>::none;
    const RigidLinks<D, Real>& links_;
    const LinkPacks<D, Real>& packs_;
    const SweepState<D, Real>& state_;

    /// Unit impulses on particles.
    struct Pushes {
        std::span<const Row> slots;
        std::span<const Vector> pushes;
    };

    /// A component in its lane.
    class Lane : LinkClusters<D, double> {
        using Clusters = LinkClusters<D, double>;
        using Fields = LinkFields<D>;
        using Arrow = lane::Arrow<D, double>;
        using Clusters::pack_, Clusters::lane_;

      public:
        using Clusters::Clusters, Clusters::factorise;
        template <class Visit> void each_link(const Visit& visit) const {
            for (std::uint32_t k = 0; k < pack_.links; ++k) visit(k);
        }
        std::array<Row, 2> ends(std::uint32_t k) const { return {slot_of(pack_.rows[k].a), slot_of(pack_.rows[k].b)}; }
        void set_along(std::uint32_t k, const Vector& to) const {
            Clusters::set_link_vector(k, Fields::along, arrow(to));
            Clusters::weigh_ends(k, pack_.rows[k], Fields::end, true);
        }

        /// Impulses of the links for pushes; returns the displacement along these, of the clusters and by the links.
        double solve(const Pushes& by) const {
            double sum = push_clusters(by);
            each_link([&](std::uint32_t k) { Clusters::set_link(k, Fields::right, rate(k, by)); });
            Clusters::solve();
            each_link([&](std::uint32_t k) { sum -= rate(k, by) * Clusters::link(k, Fields::right); });
            each_link([&](std::uint32_t k) {
                Clusters::push_ends(k, pack_.rows[k], Clusters::link(k, Fields::right));
            });
            return sum;
        }
        /// Displacement of a particle after `solve`; `free`: without links, of one that is in no cluster.
        Vector displacement_of(Row slot, Vector free) const {
            if (const auto m = member_at(slot); m != no_member)
                return vector(Clusters::pushed(cluster_of(m), m, Fields::end));
            each_link([&](std::uint32_t k) {
                for (const auto& [end, by] : pulls(k))
                    if (slot_of(end) == slot) free += vector(Clusters::link_vector(k, Fields::along)) * by;
            });
            return free;
        }
        /// Calls add(slot, displacement) after `solve`, apart from the free displacements of the pushed particles.
        template <class Add> void each_displacement(const Add& add) const {
            each_link([&](std::uint32_t k) {
                for (const auto& [end, by] : pulls(k))
                    if (by != 0) add(slot_of(end), vector(Clusters::link_vector(k, Fields::along)) * by);
            });
            Clusters::each_cluster([&](std::size_t i) {
                Clusters::each_member(i, [&](std::size_t k, std::size_t p) {
                    add(slot_of(std::uint32_t(p)), vector(Clusters::pushed(i, k, Fields::end)));
                });
            });
        }

      private:
        Row slot_of(std::uint32_t particle) const { return pack_.slots[particle * pack_.stride + lane_]; }
        static Vector vector(const Arrow& a) {
            return Vector::map([&](int i) { return a.at[i]; });
        }
        static Arrow arrow(const Vector& v) {
            Arrow a;
            for (int i = 0; i < D; ++i) a.at[i] = v[i];
            return a;
        }
        std::uint32_t member_at(Row slot) const {
            for (std::uint32_t m = 0; m < pack_.members; ++m)
                if (slot_of(pack_.particle_of[m]) == slot) return m;
            return no_member;
        }
        std::size_t cluster_of(std::uint32_t member) const {
            std::size_t i = 0;
            while (pack_.ranges[i].last <= member) ++i;
            return i;
        }
        /// Displacements along a link, for its impulse, of its ends that are in no cluster.
        std::array<std::pair<std::uint32_t, double>, 2> pulls(std::uint32_t k) const {
            const auto& row = pack_.rows[k];
            const double right = Clusters::link(k, Fields::right);
            return {std::pair{row.a, row.cluster_a == no_member ? right * Clusters::link(k, Fields::weight_a) : 0},
                    {row.b, row.cluster_b == no_member ? -right * Clusters::link(k, Fields::weight_b) : 0}};
        }
        /// Returns the displacement of clusters along the pushes, links aside.
        double push_clusters(const Pushes& by) const {
            Clusters::clear_pushes();
            for (std::size_t i = 0; i < by.slots.size(); ++i)
                if (const auto m = member_at(by.slots[i]); m != no_member) {
                    const auto c = cluster_of(m);
                    const auto push = arrow(by.pushes[i]);
                    Clusters::push(c, push * Clusters::cluster(c, Fields::per_mass),
                                   Clusters::turn_by(c, moment(Clusters::member(m, Fields::end), push)));
                }
            double sum = 0;
            for (std::size_t i = 0; i < by.slots.size(); ++i)
                if (const auto m = member_at(by.slots[i]); m != no_member)
                    sum += dot(by.pushes[i], vector(Clusters::pushed(cluster_of(m), m, Fields::end)));
            return sum;
        }
        /// Change of a link's length by the pushes, other links aside.
        double rate(std::uint32_t k, const Pushes& by) const {
            const auto& row = pack_.rows[k];
            if (!(Clusters::link(k, Fields::active) > 0)) return 0;
            return rate_of_end(k, row.b, row.cluster_b, Fields::weight_b, Fields::arm_b, by) -
                   rate_of_end(k, row.a, row.cluster_a, Fields::weight_a, Fields::arm_a, by);
        }
        double rate_of_end(std::uint32_t k, std::uint32_t particle, std::uint32_t cluster, std::size_t weight,
                           std::size_t arm, const Pushes& by) const {
            const auto along = Clusters::link_vector(k, Fields::along);
            if (cluster != no_member)
                return dot(along, Clusters::cluster_vector(cluster, Fields::push)) +
                       dot(Clusters::end(k, arm), Clusters::cluster_spin(cluster, Fields::twist));
            double sum = 0;
            for (std::size_t i = 0; i < by.slots.size(); ++i)
                if (by.slots[i] == slot_of(particle)) sum += dot(along, arrow(by.pushes[i]));
            return sum * Clusters::link(k, weight);
        }
    };
    Lane lane_of(std::uint32_t component) const {
        const auto [pack, lane] = packs_.place_of(component);
        return {packs_.list[pack], std::size_t(lane)};
    }

    /// True for the first particle of each component with links.
    bool is_first_of_component(std::span<const Row> slots, std::size_t i) const {
        const auto component = links_.component_of[slots[i]];
        const auto is_same = [&](Row slot) { return links_.component_of[slot] == component; };
        return component != none && std::ranges::none_of(slots.first(i), is_same);
    }
};

} // namespace sinew::detail

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
        for (int i = 0; i < D; ++i) {
            const auto push = Vector::axis(i);
            const auto displacement_at = respond(links_.component_of[slot], std::span(&slot, 1), std::span(&push, 1));
            matrix.column[std::size_t(i)] = displacement_at(slot);
        }
        return matrix;
    }
    /// Displacements of the particles of a component for pushes, as a function of their slots; pushes on other
    /// components have no part.
    auto respond(std::uint32_t component, std::span<const Row> slots, std::span<const Vector> pushes) const {
        const auto lane = lane_of(component);
        lane.clear_added();
        for (std::size_t i = 0; i < slots.size(); ++i)
            if (links_.component_of[slots[i]] == component) lane.push(packs_.number_of(slots[i]), pushes[i]);
        lane.respond();
        return [lane, this](Row slot) { return lane.displacement(packs_.number_of(slot)); };
    }
    /// Displacement, along the pushes, for a unit of these pushes on particles, 1 / kg.
    double along(std::span<const Row> slots, std::span<const Vector> pushes) const {
        double sum = 0;
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (links_.component_of[slots[i]] == none)
                sum += double(state_.mobility[slots[i]]) * dot(pushes[i], pushes[i]);
            else if (is_first_of_component(slots, i))
                sum += along(links_.component_of[slots[i]], slots, pushes);
        }
        return max(sum, 0.0);
    }

    /// Moves the particles by a multiple of the displacement for which `along` has last been asked.
    void move(SweepState<D, Real>& state, std::span<const Row> slots, std::span<const Vector> pushes,
              double impulse) const {
        const Real furthest = max_displacement(Real(1) / state.per_h);
        const auto add = [&](Row slot, const Vector& moved) {
            const auto to = state.displacement_at(slot) + cast<Real>(moved);
            state.set_displacement(slot, clamp_components(to, furthest));
        };
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (links_.component_of[slots[i]] == none) {
                if (const double mobility = double(state.mobility[slots[i]]); mobility > 0)
                    add(slots[i], pushes[i] * (impulse * mobility));
            } else if (is_first_of_component(slots, i)) {
                const auto lane = lane_of(links_.component_of[slots[i]]);
                lane.each_movable([&](std::uint32_t k) { add(lane.slot_of(k), lane.displacement(k) * impulse); });
            }
        }
    }
    /// Holds the lengths of a component as they change at the end of the displacements, from now on in the substep. A
    /// straight rope gives way across it, and is stiff once it is bent.
    void turn(std::uint32_t component) const { lane_of(component).turn(state_); }

  private:
    static constexpr auto none = RigidLinks<D, Real>::none;
    const RigidLinks<D, Real>& links_;
    const LinkPacks<D, Real>& packs_;
    const SweepState<D, Real>& state_;

    /// A component in its lane.
    class Lane : LinkClusters<D, double> {
        using Clusters = LinkClusters<D, double>;
        using Lanes = LinkLanes<D, double>;
        using Fields = LinkFields<D>;
        using Lanes::pack_, Lanes::lane_;

      public:
        using Clusters::Clusters;
        Row slot_of(std::uint32_t particle) const { return pack_.slots[particle * pack_.stride + lane_]; }
        template <class Visit> void each_movable(const Visit& visit) const {
            for (std::uint32_t i = 0; i < pack_.particles; ++i)
                if (pack_.moves[i]) visit(i);
        }
        Vector displacement(std::uint32_t particle) const { return vector(particle, Fields::added); }

        using Clusters::clear_added;
        void push(std::uint32_t particle, const Vector& by) const { Clusters::push(particle, numbers(by)); }
        /// Displacements for the pushes since `clear_added`, with the lengths held.
        void respond() const {
            each_link([&](std::uint32_t k, const LinkRow& row) {
                const double change = Clusters::rate(k, row, Fields::added, Fields::added_move, Fields::added_turn);
                Lanes::set_link(k, Fields::right, Lanes::link(k, Fields::active) > 0 ? change : 0);
            });
            Lanes::solve();
            each_link([&](std::uint32_t k, const LinkRow& row) {
                Clusters::pull(k, row, Lanes::link(k, Fields::right), Fields::added, Fields::added_move,
                               Fields::added_turn);
            });
            Clusters::spread_added();
        }
        /// Directions at the end of the displacements.
        void turn(const SweepState<D, Real>& state) const {
            for (std::uint32_t i = 0; i < pack_.particles; ++i)
                Lanes::set_particle_vector(i, Fields::displacement,
                                           numbers(cast<double>(state.displacement_at(slot_of(i)))));
            Clusters::find_moves();
            each_link([&](std::uint32_t k, const LinkRow& row) {
                const Row a = slot_of(row.a), b = slot_of(row.b);
                const auto edge = cast<double>(state.position_at(b) - state.position_at(a)) +
                                  cast<double>(state.displacement_at(b) - state.displacement_at(a));
                Lanes::set_link_vector(k, Fields::along, numbers(edge * inverse_or_zero(norm(edge))));
                Clusters::take_levers(k, row, true, true);
            });
            Clusters::factorise(true);
        }

      private:
        static typename Lanes::Vector numbers(const Vector& from) {
            typename Lanes::Vector to;
            for (std::size_t i = 0; i < D; ++i) to.at[i] = from[int(i)];
            return to;
        }
        Vector vector(std::uint32_t particle, std::size_t field) const {
            const auto from = Lanes::particle_vector(particle, field);
            return Vector::map([&](int i) { return from.at[i]; });
        }
        template <class Visit> void each_link(const Visit& visit) const {
            for (std::uint32_t k = 0; k < pack_.links; ++k) visit(k, pack_.rows[k]);
        }
        static double norm(const Vector& v) { return sinew::norm(v); }
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
    double along(std::uint32_t component, std::span<const Row> slots, std::span<const Vector> pushes) const {
        const auto displacement_at = respond(component, slots, pushes);
        double sum = 0;
        for (std::size_t i = 0; i < slots.size(); ++i)
            if (links_.component_of[slots[i]] == component) sum += dot(pushes[i], displacement_at(slots[i]));
        return sum;
    }
};

} // namespace sinew::detail

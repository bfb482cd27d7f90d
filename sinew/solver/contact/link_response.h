#pragma once

#include "sinew/math/matrix.h"
#include "sinew/solver/contact/link_packs.h"
#include "sinew/solver/simd/link_factor.h"

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
        const auto lanes = lanes_of(links_.component_of[slot]);
        for (int i = 0; i < D; ++i) {
            each(lanes, [&](std::uint32_t k) { lanes.set_right(k, lanes.pull(k, slot) * lanes.along(k)[i]); });
            lanes.solve();
            each(lanes, [&](std::uint32_t k) {
                matrix.column[std::size_t(i)] += lanes.along(k) * (-lanes.pull(k, slot) * lanes.right(k));
            });
        }
        return matrix;
    }
    /// Displacement, along the pushes, for a unit of these pushes on particles, 1 / kg.
    double along(std::span<const Row> slots, std::span<const Vector> pushes) const {
        double sum = 0;
        for (std::size_t i = 0; i < slots.size(); ++i) {
            sum += double(state_.mobility[slots[i]]) * dot(pushes[i], pushes[i]);
            if (is_first_of_component(slots, i)) sum -= held_back(links_.component_of[slots[i]], slots, pushes);
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
        for (std::size_t i = 0; i < slots.size(); ++i)
            if (const double mobility = double(state.mobility[slots[i]]); mobility > 0)
                add(slots[i], pushes[i] * (impulse * mobility));
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (!is_first_of_component(slots, i)) continue;
            const auto lane = lanes_of(links_.component_of[slots[i]]);
            each(lane, [&](std::uint32_t k) {
                for (const Row slot : lane.ends(k))
                    if (const double pull = lane.pull(k, slot); pull != 0)
                        add(slot, lane.along(k) * (-pull * impulse * lane.right(k)));
            });
        }
    }
    /// Holds the lengths of a component as they change at the end of the displacements, from now on in the substep. A
    /// straight rope gives way across it, and is stiff once it is bent.
    void turn(std::uint32_t component) const {
        const auto lane = lanes_of(component);
        each(lane, [&](std::uint32_t k) {
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

    /// A component in its lane.
    class Lane : LinkLanes<D, double> {
        using Lanes = LinkLanes<D, double>;
        using Fields = LinkFields<D>;
        using Lanes::pack_, Lanes::lane_;

      public:
        using Lanes::Lanes, Lanes::solve, Lanes::factorise;
        std::uint32_t size() const { return pack_.links; }
        double right(std::uint32_t k) const { return Lanes::link(k, Fields::right); }
        void set_right(std::uint32_t k, double to) const { Lanes::set_link(k, Fields::right, to); }
        bool is_active(std::uint32_t k) const { return Lanes::link(k, Fields::active) > 0; }
        Vector along(std::uint32_t k) const {
            const auto numbers = Lanes::link_vector(k, Fields::along);
            return Vector::map([&](int i) { return numbers.at[i]; });
        }
        void set_along(std::uint32_t k, const Vector& to) const {
            typename Lanes::Vector numbers;
            for (std::size_t i = 0; i < D; ++i) numbers.at[i] = to[int(i)];
            Lanes::set_link_vector(k, Fields::along, numbers);
        }
        std::array<Row, 2> ends(std::uint32_t k) const { return {slot_of(pack_.rows[k].a), slot_of(pack_.rows[k].b)}; }
        /// Change of a link's length for a unit displacement of a particle along it, times the inverse mass.
        double pull(std::uint32_t k, Row slot) const {
            const auto& row = pack_.rows[k];
            return (slot_of(row.b) == slot ? Lanes::link(k, Fields::weight_b) : 0) -
                   (slot_of(row.a) == slot ? Lanes::link(k, Fields::weight_a) : 0);
        }

      private:
        Row slot_of(std::uint32_t particle) const { return pack_.slots[particle * pack_.stride + lane_]; }
    };
    Lane lanes_of(std::uint32_t component) const {
        const auto [pack, lane] = packs_.place_of(component);
        return {packs_.list[pack], std::size_t(lane)};
    }

    /// True for the first particle of each component with links.
    bool is_first_of_component(std::span<const Row> slots, std::size_t i) const {
        const auto component = links_.component_of[slots[i]];
        const auto is_same = [&](Row slot) { return links_.component_of[slot] == component; };
        return component != none && std::ranges::none_of(slots.first(i), is_same);
    }
    template <class Visit> static void each(const Lane& lane, Visit&& visit) {
        for (std::uint32_t k = 0; k < lane.size(); ++k) visit(k);
    }
    /// Share of the displacement which the links of a component take back.
    double held_back(std::uint32_t component, std::span<const Row> slots, std::span<const Vector> pushes) const {
        const auto lane = lanes_of(component);
        const auto change = [&](std::uint32_t k) {
            double sum = 0;
            for (std::size_t i = 0; i < slots.size(); ++i)
                if (const double weight = lane.pull(k, slots[i]); weight != 0)
                    sum += weight * dot(lane.along(k), pushes[i]);
            return lane.is_active(k) ? sum : 0;
        };
        each(lane, [&](std::uint32_t k) { lane.set_right(k, change(k)); });
        lane.solve();
        double sum = 0;
        each(lane, [&](std::uint32_t k) { sum += change(k) * lane.right(k); });
        return sum;
    }
};

} // namespace sinew::detail

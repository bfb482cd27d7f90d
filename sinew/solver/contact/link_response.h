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
            const auto component = links_.component_of[slots[i]];
            const auto earlier = slots.first(i);
            const bool is_new = std::none_of(earlier.begin(), earlier.end(),
                                             [&](Row slot) { return links_.component_of[slot] == component; });
            if (component != none && is_new) sum -= held_back(component, slots, pushes);
        }
        return max(sum, 0.0);
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
        using Lanes::Lanes, Lanes::solve;
        std::uint32_t size() const { return pack_.links; }
        double right(std::uint32_t k) const { return Lanes::link(k, Fields::right); }
        void set_right(std::uint32_t k, double to) const { Lanes::set_link(k, Fields::right, to); }
        bool is_active(std::uint32_t k) const { return Lanes::link(k, Fields::active) > 0; }
        Vector along(std::uint32_t k) const {
            const auto numbers = Lanes::link_vector(k, Fields::along);
            return Vector::map([&](int i) { return numbers.at[i]; });
        }
        /// Change of a link's length for a unit displacement of a particle along it, times the inverse mass.
        double pull(std::uint32_t k, Row slot) const {
            const auto& row = pack_.rows[k];
            const auto slot_of = [&](std::uint32_t i) { return pack_.slots[i * pack_.stride + lane_]; };
            return (slot_of(row.b) == slot ? Lanes::link(k, Fields::weight_b) : 0) -
                   (slot_of(row.a) == slot ? Lanes::link(k, Fields::weight_a) : 0);
        }
    };
    Lane lanes_of(std::uint32_t component) const {
        const auto [pack, lane] = packs_.place_of(component);
        return {packs_.list[pack], std::size_t(lane)};
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

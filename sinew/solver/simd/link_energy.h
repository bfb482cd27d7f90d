#pragma once

#include "sinew/solver/simd/lane_spin.h"
#include "sinew/solver/simd/link_exchange.h"

namespace sinew {
namespace {

/// Energy of the components in the lanes of V, and their angular momentum: a gain by the corrections of a substep is
/// taken from the motion relative to the rigid body with the same momenta.
template <int D, class Real, class V> class LinkEnergy : protected LinkExchange<D, Real, V> {
  protected:
    using Exchange = LinkExchange<D, Real, V>;
    using Solution = LinkSolution<D, V>;
    using Fields = LinkFields<D>;
    using Turn = lane::Spin<D, V>;
    using Exchange::columns_, Exchange::gather, Exchange::Exchange;
    using Solution::blend, Solution::displacement, Solution::number, Solution::inverse_or_zero, Solution::pack_;
    using Solution::frame, Solution::energy_in, Solution::particle, Solution::particle_vector;
    using Solution::set_particle_vector;
    using typename Solution::Mask, typename Solution::Vector;

    Vector place(std::uint32_t i) const {
        Vector at;
        for (std::size_t c = 0; c < D; ++c) at.at[c] = gather(columns_.position + c * columns_.stride, i);
        return at;
    }

    /// Rigid body at the present places. A component with a particle that cannot move has no momentum of its own:
    /// its body does not turn.
    class Body {
      public:
        explicit Body(const LinkEnergy& links) : links_(links) {
            V mass{};
            Mask stands = V{} > V{};
            each([&](std::uint32_t i) {
                mass = mass + links_.particle(i, Fields::mass);
                centre_ = centre_ + links_.place(i) * links_.particle(i, Fields::mass);
                stands = Solution::either(stands, links_.particle(i, Fields::mobility) <= V{});
            });
            centre_ = centre_ * links_.inverse_or_zero(mass);
            turns_ = stands ? V{} : links_.number(1);
            each([&](std::uint32_t i) { inertia_.add(arm(i), links_.particle(i, Fields::mass)); });
        }
        Vector arm(std::uint32_t i) const { return links_.place(i) - centre_; }
        /// Angular momentum about the centre of mass by the displacements in a field, times h.
        Turn spin(std::size_t displacement = Fields::displacement) const {
            Turn sum{};
            each([&](std::uint32_t i) {
                const Vector moved = links_.particle_vector(i, displacement);
                sum = sum + lane::moment(arm(i), moved * links_.particle(i, Fields::mass));
            });
            return sum * turns_;
        }
        /// Twice the energy, times h^2, of a rounding error of the lengths.
        V rounding() const {
            constexpr double exact = sizeof(Real) == sizeof(float) ? 1e-6 : 1e-9;
            return inertia_.size() * links_.number(exact * exact);
        }
        Turn rate_of(const Turn& spin) const { return inertia_.rate_across(spin); }
        Vector by(const Turn& turn, std::uint32_t i) const { return lane::turning(turn, arm(i)); }
        template <class Visit> void each(const Visit& visit) const {
            for (std::uint32_t i = 0; i < links_.pack_.particles; ++i) visit(i);
        }

      private:
        const LinkEnergy& links_;
        Vector centre_{};
        V turns_{}; ///< 1 or 0
        lane::Inertia<D, V> inertia_;
    };

    /// Loads displacements that contacts and guards may have shortened since the lengths were corrected: the loss is
    /// not due.
    void load_shortened(const Mask& mask) const {
        constexpr double exact = 1e-5; // rounding of floats is no loss
        const V whole = energy_in(frame());
        for (std::uint32_t i = 0; i < pack_.particles; ++i) set_particle_vector(i, Fields::added, displacement(i));
        this->load();
        for (std::uint32_t i = 0; i < pack_.particles; ++i)
            set_particle_vector(i, Fields::displacement,
                                blend(mask, displacement(i), particle_vector(i, Fields::added)));
        const V left = energy_in(frame()), lost = left < whole * number(1 - exact) ? whole - left : V{};
        Solution::set_energy(lane::max(Solution::energy() - lost, V{}));
        Solution::set_least_energy(Solution::least_energy() - lost);
    }

    // --- work --------------------------------------------------------------------------------------------------------
    //
    // With d the displacements, g gravity and h the substep, energies times 2 h^2: gravity has given the velocities
    //     sum of m h^2 g (d before the step + d predicted);    its work is    2 sum of m h^2 g d.

    /// Sum of m h^2 g d.
    V fall() const {
        V sum{};
        for (std::uint32_t i = 0; i < pack_.particles; ++i)
            for (std::size_t c = 0; c < D; ++c)
                sum = sum + displacement(i).at[c] * particle(i, Fields::mass) * number(columns_.fall[int(c)]);
        return sum;
    }
    /// Energy due at least, without half of gravity's work on the velocities in the substep; none where
    /// other forces act, and none for ropes, which lose some as they snap taut.
    V with_fall() const {
        if (pack_.has_ropes || !columns_.only_falls) return number(LinkPack<D>::no_energy);
        return energy_in(frame()) - fall();
    }
    void add_work(const V& work) const {
        Solution::set_least_energy(lane::min(Solution::least_energy() + work, Solution::energy()));
    }

    /// Gives the components a mean displacement and an angular momentum.
    void set_momenta(const Mask& mask, const Body& body, const Vector& drift, const Turn& spin) const {
        const Turn turn = body.rate_of(spin - body.spin());
        const Vector shift = drift - frame();
        body.each([&](std::uint32_t i) {
            const Vector moved = displacement(i);
            set_particle_vector(i, Fields::displacement, blend(mask, moved + shift + body.by(turn, i), moved));
        });
    }
    /// Turns the components at the end of their displacements until they have the angular momentum of before (Newton's
    /// method).
    void turn_back(const Mask& mask) const {
        constexpr int rounds = 4;
        const Body body(*this);
        const Turn spin = body.spin(Fields::before);
        for (int round = 0; round < rounds; ++round) {
            const Vector drift = frame();
            const auto arm_after = [&](std::uint32_t i) { return body.arm(i) + displacement(i) - drift; };
            lane::Inertia<D, V> inertia;
            body.each([&](std::uint32_t i) { inertia.add(body.arm(i), arm_after(i), particle(i, Fields::mass)); });
            const Turn half = inertia.rate_across(spin - body.spin()) * number(0.5);
            const V share = number(2) / (number(1) + dot(half, half));
            body.each([&](std::uint32_t i) {
                const Vector moved = displacement(i), once = lane::turning(half, arm_after(i));
                const Vector turned = (once + lane::turning(half, once)) * share;
                set_particle_vector(i, Fields::displacement, blend(mask, moved + turned, moved));
            });
        }
    }
    /// Gives motion the energy due: at first motion apart from the rigid body's slows down, or becomes faster. Rounding
    /// in a rigid body does not.
    void scale(const Mask& mask, const Body& body, const V& due) const {
        if (!lane::any(mask)) return;
        constexpr double most = 16, rounding = 1e-6;
        const Vector drift = frame();
        const Turn spin = body.spin(), turn = body.rate_of(spin);
        const V rigid = dot(turn, spin), inner = energy_in(drift) - rigid;
        const V left = lane::max(due - rigid, V{});
        V largest = inner > due * number(rounding) ? number(most) : number(1);
        body.each([&](std::uint32_t i) {
            const Vector moved = displacement(i);
            for (std::size_t c = 0; c < D; ++c)
                largest = lane::size_of(moved.at[c]) > number(0.25 * columns_.furthest) ? number(1) : largest;
        });
        const V within = lane::root(V(lane::min(left * inverse_or_zero(inner), largest)));
        const V whole = lane::root(V(lane::min(due * inverse_or_zero(rigid), number(1))));
        const V share = rigid > V{} ? whole : number(1);
        body.each([&](std::uint32_t i) {
            const Vector moved = displacement(i), turning = body.by(turn, i);
            const Vector scaled = drift + turning * share + (moved - drift - turning) * within;
            set_particle_vector(i, Fields::displacement, blend(mask, scaled, moved));
        });
    }
};

} // namespace
} // namespace sinew

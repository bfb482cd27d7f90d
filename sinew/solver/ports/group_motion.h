#pragma once

#include "sinew/solver/rigid_motion.h"
#include "sinew/solver/solver.h"

#include <algorithm>
#include <ranges>

namespace sinew::detail {

/// Motion of the members of a group in a substep. Displacements stand for velocities, energies are times h^2.
template <int D, class Real> class GroupMotion {
  public:
    using Vector = Vec<D, double>;
    using Motion = RigidMotion<D>;
    using Spin = typename Motion::Spin;

    GroupMotion(SweepState<D, Real>& swept, const Ports<D>& ports, const PortGroup<D>& group)
        : swept_(swept), ports_(ports), group_(group) {}

    std::span<const std::uint32_t> members() const {
        return std::span(ports_.members).subspan(group_.first, group_.members);
    }
    std::span<const std::uint32_t> anchors() const {
        return std::span(ports_.anchors).subspan(group_.first_anchor, group_.anchors);
    }
    double mass(Row slot) const { return inverse_or_zero(ports_.mobilities[slot]); }
    Vector position(Row slot) const { return cast<double>(swept_.position_at(slot)); }
    Vector displacement(Row slot) const { return cast<double>(swept_.displacement_at(slot)); }
    /// Displacement in the substep before.
    const Vector& last_displacement(Row slot) const { return ports_.last_displacements[slot]; }
    /// Displacement without constraints.
    const Vector& free_move(Row slot) const { return ports_.free_moves[slot]; }

    Motion rigid() const { return Motion::of(bodies(), position_of); }

    /// Motion of a rigid body, in which the rest of a group's motion is measured.
    struct Frame {
        Vector center{}, velocity{};
        Spin rate{}; ///< radians a substep

        Vector at(const Vector& position) const { return velocity + turning(rate, position - center); }
    };
    Frame frame_of(const Motion& motion) const {
        return {motion.center, motion.momentum * inverse_or_zero(motion.mass), motion.rate_of(bodies(), position_of)};
    }
    /// Frame in which energy is measured: pins that are all carried alike do no work in this one. False for other pins.
    bool find_frame(Frame& frame) const {
        const auto held = anchors();
        if (held.empty()) {
            frame = frame_of(rigid());
            return true;
        }
        frame.velocity = displacement(held.front());
        return std::all_of(held.begin(), held.end(), [&](Row s) { return displacement(s) == frame.velocity; });
    }

    /// Energy of the motion relative to a frame.
    double energy_beside(const Frame& frame) const {
        double sum = 0;
        for (const auto s : members()) {
            const auto own = displacement(s) - frame.at(position(s));
            sum += 0.5 * mass(s) * dot(own, own);
        }
        return sum;
    }
    /// Energy that a group gains about its centre if it turns as one frame in place of the other.
    double energy_between(const Frame& one, const Frame& other) const {
        double sum = 0;
        for (const auto s : members()) {
            const auto from = one.at(position(s)) - one.velocity, to = other.at(position(s)) - other.velocity;
            sum += 0.5 * mass(s) * (dot(to, to) - dot(from, from));
        }
        return sum;
    }

    /// Puts one frame in place of another, and scales the motion beside.
    void replace(const Frame& frame, const Frame& other, double share) const {
        for (const auto s : members()) {
            const auto own = displacement(s) - frame.at(position(s));
            put(s, other.at(position(s)) + own * share);
        }
    }
    /// Takes the mean motion that constraints have added: they act within, and what they add is the rounding of the
    /// large moves of light members.
    void take_drift() const {
        Vector added{};
        double whole = 0;
        for (const auto s : members()) added += (displacement(s) - free_move(s)) * mass(s), whole += mass(s);
        const auto drift = added * inverse_or_zero(whole);
        for (const auto s : members()) put(s, displacement(s) - drift);
    }
    /// Moves all members with a frame.
    void stiffen(const Frame& frame) const {
        for (const auto s : members()) put(s, frame.at(position(s)));
    }

  private:
    SweepState<D, Real>& swept_;
    const Ports<D>& ports_;
    const PortGroup<D>& group_;

    /// Displaces a particle, no faster than anything may be: a group that is a point has no inertia to turn with.
    void put(Row slot, const Vector& displacement) const {
        const auto furthest = double(max_displacement(Real(1) / swept_.per_h));
        swept_.set_displacement(slot, cast<Real>(clamp_components(displacement, furthest)));
    }

    /// A particle with its displacement in the substep as its velocity.
    struct Body {
        double mass = 0;
        Vector position{}, velocity{};
    };
    static Vector position_of(const Body& body) { return body.position; }
    auto bodies() const {
        return std::views::transform(members(), [this](Row s) { return Body{mass(s), position(s), displacement(s)}; });
    }
};

template <int D, class Real> using GroupFrame = typename GroupMotion<D, Real>::Frame;

} // namespace sinew::detail

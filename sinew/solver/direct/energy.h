#pragma once

#include "sinew/solver/direct/newton.h"
#include "sinew/solver/rigid_motion.h"

/// Conservation in a block: of energy, and in a free block of momentum and angular momentum.
namespace sinew::detail {

template <int D> class BlockEnergy {
  public:
    using Solve = BlockSolve<D>;
    using Motion = RigidMotion<D>;

    BlockEnergy(const Solve& solve, bool free) : solve_(solve), free_(free) {
        if (free_) begun_ = Motion::of(solve_.unknowns(), Solve::start_of);
    }

    /// Work of the force fields in the substep, less the increase of energy in springs.
    double work() const { return work_of_fields() - gain_of_springs(); }
    double work_of_fields() const {
        double sum = 0;
        for (const auto& node : solve_.unknowns())
            sum += node.mass * dot(node.acceleration, node.position - node.start);
        return sum;
    }
    double gain_of_springs() const {
        double sum = 0;
        if (!solve_.block().springy) return sum;
        for (const auto& link : solve_.links().all())
            sum += solve_.links().stored(link, solve_.node(link.b).position - solve_.node(link.a).position) -
                   solve_.links().stored(link, link.start);
        for (const auto& bend : solve_.bends().all())
            sum += solve_.bends().stored(bend, false) - solve_.bends().stored(bend, true);
        for (const auto& way : solve_.ways().all())
            sum += solve_.ways().stored(way, false) - solve_.ways().stored(way, true);
        return sum;
    }

    /// Excess of the energy after a midpoint step over the energy due, in units of the rounding tolerance.
    double gain() {
        constexpr double rounding = 1e-6, tiny = 2e-7;
        const double per_h = 2 / solve_.substep();
        double before = 0;
        after_ = 0;
        typename Solve::Vector momentum{}, momentum_after{};
        for (const auto& node : solve_.unknowns()) {
            const auto velocity = (node.position - node.start) * per_h - node.velocity;
            before += 0.5 * node.mass * dot(node.velocity, node.velocity);
            after_ += 0.5 * node.mass * dot(velocity, velocity);
            momentum += node.velocity * node.mass;
            momentum_after += velocity * node.mass;
        }
        due_ = before + work();
        const double inner = before + after_ - of_the_whole(momentum) - of_the_whole(momentum_after);
        return (after_ - due_) * inverse_or_zero(rounding * inner + tiny * solve_.weight() * solve_.total_length());
    }

    /// The kinetic energy of a free block about its centre; of any other, all of it. No decision about a free one may
    /// depend on how fast it flies.
    double inner() const {
        typename Solve::Vector momentum{};
        for (const auto& node : solve_.unknowns()) momentum += node.velocity * node.mass;
        return solve_.kinetic() - of_the_whole(momentum);
    }

    /// Kinetic energy of the flight of a free block at the end of the substep, by the velocities at the start; zero of
    /// any other.
    double flight() const {
        typename Solve::Vector momentum{};
        for (const auto& node : solve_.unknowns())
            momentum += (node.velocity + node.acceleration * solve_.substep()) * node.mass;
        return of_the_whole(momentum);
    }

    /// Kinetic energy due at the end of the substep, and the deficit.
    double due() const { return due_; }
    /// True if the velocities have more, by more than rounding.
    bool exceeds_due() const {
        constexpr double rounding = 1e-6;
        return solve_.kinetic() - due_ > rounding * inner();
    }
    double missing() const { return max(due_ - after_, 0.0); }

    /// Scales the motion relative to the rigid-body motion down until the kinetic energy is at most `max`.
    void slow_down(double max) const {
        if (solve_.kinetic() > max) bring_to(max);
    }

    /// Scales the motion relative to the rigid-body motion until the kinetic energy is `kinetic`.
    void bring_to(double kinetic) const {
        constexpr double fastest = 1.1; // a correction, not a kick
        const auto unknowns = solve_.unknowns();
        const auto motion = free_ ? Motion::of(unknowns, Solve::position_of) : Motion{};
        const auto rate = motion.rate_of(unknowns, Solve::position_of);
        const auto whole = [&](const BlockNode<D>& node) {
            return motion.momentum * inverse_or_zero(motion.mass) + turning(rate, node.position - motion.center);
        };
        double kept = 0;
        for (const auto& node : unknowns) kept += 0.5 * node.mass * dot(whole(node), whole(node));
        const double share =
            min(fastest, square_root(max(kinetic - kept, 0.0) * inverse_or_zero(solve_.kinetic() - kept)));
        for (auto& node : unknowns) node.velocity = whole(node) + (node.velocity - whole(node)) * share;
    }

    /// Moves a free block by what its centre lacks of the way of its flight: a shortened motion is one within.
    void keep_flight() const {
        if (!free_) return;
        const auto unknowns = solve_.unknowns();
        const auto now = Motion::of(unknowns, Solve::position_of);
        auto momentum = begun_.momentum;
        for (const auto& node : unknowns) momentum += node.acceleration * (node.mass * solve_.substep());
        const auto missing = begun_.center - now.center + momentum * (solve_.substep() * inverse_or_zero(now.mass));
        for (auto& node : unknowns) node.position += missing;
    }

    /// Restores momentum and angular momentum of a free block: the initial ones plus the impulses of the fields, since
    /// links act within. The moment of a field is taken about the mean of the centres at both ends of the substep:
    /// about either one of the two a figure in flight would be turned by its own weight.
    void keep_momentum() const {
        if (!free_) return;
        const auto unknowns = solve_.unknowns();
        auto missing = Motion::of(unknowns, Solve::position_of);
        const auto center = (begun_.center + missing.center) * 0.5;
        Motion due = begun_;
        for (const auto& node : unknowns) {
            const auto kick = node.acceleration * (node.mass * solve_.substep());
            due.momentum += kick;
            due.spin += moment((node.start + node.position) * 0.5 - center, kick);
        }
        missing.momentum = due.momentum - missing.momentum;
        missing.spin = due.spin - missing.spin;
        const auto rate = missing.rate_of(unknowns, Solve::position_of);
        const auto drift = missing.momentum * inverse_or_zero(missing.mass);
        for (auto& node : unknowns) node.velocity += drift + turning(rate, node.position - missing.center);
    }

  private:
    const Solve& solve_;
    bool free_;
    double due_ = 0, after_ = 0;
    Motion begun_{}; ///< motion of a free block at the start of the substep

    double of_the_whole(const typename Solve::Vector& momentum) const {
        return free_ ? 0.5 * dot(momentum, momentum) * inverse_or_zero(solve_.total_mass()) : 0;
    }
};

} // namespace sinew::detail

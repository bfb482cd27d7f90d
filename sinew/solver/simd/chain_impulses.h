#pragma once

#include "sinew/solver/simd/chain_equations.h"

/// Impulses along the links of chains side by side in lanes, after the crack of a whip or where a link snaps taut.
namespace sinew {
namespace {

template <int D, class V> class ChainImpulses : protected ChainEquations<D, V> {
    using Equations = ChainEquations<D, V>;

  protected:
    using Equations::ChainEquations;
    using Equations::nodes_, Equations::links_, Equations::tightened_, Equations::pulls_only;
    using Equations::number, Equations::of, Equations::at, Equations::after_, Equations::exact, Equations::pack_;
    using typename Equations::Mask;
    using typename Equations::Pair;

    /// Removes velocities along the links, an error of the midpoint rule after the crack of a whip, and gives their
    /// energy back to the allowed motion; that of a link that has just become taut is lost. Multipliers f solve a
    /// tridiagonal system, e_i . (v_i - v_before) = 0:
    ///
    ///     v_i += (f_next e_next - f_i e_i) / m_i
    void straighten(const Mask& struck, Mask& good, V& alien, V& lost) {
        const Mask tightened = tightened_ > V{};
        for (int i = 1; i <= links_; ++i)
            nodes_[i].holds = both(pulls_only(nodes_[i]), nodes_[i].pull <= V{}) ? V{} : number(1);
        constexpr int rounds = 8;
        V kinetic{};
        Mask undecided = struck;
        for (int i = 0; i < rounds && any(undecided); ++i) {
            solve_tridiagonal();
            kinetic = apply_impulses();
            undecided = both(struck, change_sides());
        }
        constexpr double fastest = 1.1, much = 1.02;
        const V share = tightened ? number(1) : min(root(after_ / kinetic), number(fastest));
        for (int i = 1; i <= links_; ++i)
            for (int k = 0; k < D; ++k)
                nodes_[i].after[k] = struck ? nodes_[i].displacement[k] * share : nodes_[i].after[k];
        const Mask little = (after_ <= kinetic * number(much)) | tightened, shortest = of(pack_.shortest) > V{};
        good = without(good, without(without(struck, little), shortest));
        alien = both(good, undecided) ? number(1) : alien;
        good = without(good, undecided);
        lost = struck ? lost + (after_ - kinetic * share * share) : lost;
    }
    /// Velocities after the impulses, in `displacement`; returns the kinetic energy, J.
    V apply_impulses() {
        V kinetic{};
        Pair before_next{};
        for (int i = links_; i > 0; --i) {
            auto& node = nodes_[i];
            const Pair impulse = at(node.span) * node.next, kick = (before_next - impulse) * (number(1) / node.mass);
            const Pair velocity = at(node.after) + kick;
            velocity.to(node.displacement);
            kinetic = kinetic + dot(velocity, velocity) * node.mass * number(0.5);
            before_next = impulse;
        }
        return kinetic;
    }
    /// Active set of the impulses: a link under tension that would push is released, one that would get longer holds.
    /// Lanes in which there were any.
    Mask change_sides() {
        V changed{};
        Pair before{};
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            const V growth =
                dot(at(node.span), at(node.displacement) - before) * node.per_length2 * number(pack_.longest);
            const Mask may = both(pulls_only(node), node.pull > V{}), holds = node.holds > V{};
            const Mask pushes = both(both(may, holds), node.next < V{});
            const Mask grows = both(without(may, holds), growth > number(exact));
            node.holds = pushes ? V{} : grows ? number(1) : node.holds;
            changed = (pushes | grows) ? number(1) : changed;
            before = at(node.displacement);
        }
        return changed > V{};
    }
    void solve_tridiagonal() {
        V lighter{}, side{}, right{}, ratio{}; // of the node before: 1 / mass, and the eliminated row
        Pair velocity_before{}, span_before{};
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            const Pair span = at(node.span) * node.holds, velocity = at(node.after);
            const V mobility = number(1) / node.mass;
            side = -dot(span_before, span) * lighter;
            const V pivot = node.holds > V{} ? dot(span, span) * (lighter + mobility) - side * ratio : number(1);
            right = (dot(span, velocity - velocity_before) - side * right) / pivot;
            node.error = right;
            const Pair next = i < links_ ? at(nodes_[i + 1].span) * nodes_[i + 1].holds : Pair{};
            ratio = -dot(span, next) * mobility / pivot;
            node.stiffness = ratio;
            lighter = mobility, velocity_before = velocity, span_before = span;
        }
        V f{};
        for (int i = links_; i > 0; --i) f = nodes_[i].next = nodes_[i].error - nodes_[i].stiffness * f;
    }
};

} // namespace
} // namespace sinew

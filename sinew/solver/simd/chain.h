#pragma once

#include "sinew/solver/simd/chain_pack.h"
#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/lane_swing.h"

/// Kernel of chains: a substep by the midpoint rule, as direct/newton.h has it, for chains side by side in lanes.
namespace sinew {
namespace {

template <int D, class V> class ChainSwing : LaneSwing<D, V> {
    using Base = LaneSwing<D, V>;
    using Base::active_at_start_, Base::far2_, Base::moved2_, Base::before_, Base::after_, Base::due_, Base::jolt_;
    using Base::number, Base::of, Base::at, Base::h_, Base::keep_, Base::half_h2_, Base::least_pull_, Base::beyond_;
    using Base::usual_error, Base::exact, Base::hardly, Base::crude, Base::as_good_as_taut, Base::most_iterations;
    using typename Base::Mask;
    using typename Base::Pair;

  public:
    using Node = ChainNode<D, V>;

    explicit ChainSwing(ChainPack<D>& pack)
        : Base(pack), pack_(pack), nodes_(reinterpret_cast<Node*>(pack.nodes)), links_(pack.links),
          slight_(of(pack.weight_reach) * half_h2_ * number(1e-6 * pack.links) / (of(pack.reach) * of(pack.reach))) {}

    void run() {
        Mask active = of(pack_.active) > V{};
        const Mask chosen = active, none = without(active, active);
        V alien{};
        set_out();
        active = without(active, unfit());
        Mask good = none;
        iterate(active, good);
        alien = without(chosen, active_at_start_) ? number(1) : alien;
        const Mask astray = both(good, (least_pull_ < -slight_) | (beyond_ > V{}));
        good = without(good, astray);
        alien = astray ? number(1) : alien;
        const Mask struck = both(good, (jolt_ * number(pack_.longest) > number(usual_error)) | (tightened_ > V{}));
        V lost = most(due_ - after_, V{});
        if (any(struck)) straighten(struck, good, alien, lost);
        if (any(good)) store_good(good);
        Base::report(good, alien, lost);
    }

  private:
    ChainPack<D>& pack_;
    Node* nodes_;
    int links_;
    V slight_;      ///< multiplier that counts as zero, kg
    V flipped_{};   ///< 1: the active set changed in this iteration
    V tightened_{}; ///< 1: a link that pulled nothing at the start is active

    static Mask pulls_only(const Node& node) { return node.pulls_only > V{}; }

    /// Free flight, and the tensions of the last substep.
    void set_out() {
        const V unit = half_h2_ * of(pack_.yield);
        const Pair fall = Base::push() * half_h2_;
        at(nodes_[0].start).to(nodes_[0].place);
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            const Pair start = at(node.start), velocity = at(node.velocity) * keep_, place = start + velocity * h_;
            place.to(node.place);
            (place + fall).to(node.aim);
            (start - at(nodes_[i - 1].start)).to(node.begun);
            (place - at(nodes_[i - 1].place)).to(node.span);
            node.pull = node.tension * unit;
            const Pair span = at(node.begun);
            const V length2 = dot(span, span) * node.per_length2;
            const Mask slack = both(pulls_only(node), both(node.tension <= V{}, length2 < number(as_good_as_taut)));
            node.holds = slack ? V{} : number(1);
            node.flips = V{};
            before_ = before_ + dot(velocity, velocity) * node.mass * number(0.5);
        }
    }

    /// Lanes in a state that the midpoint rule does not start from: at a fresh start lengths or velocities of
    /// links that pull, or cannot go slack, that are wrong.
    Mask unfit() {
        V strain{}, rate{};
        Pair before{};
        for (int i = 1; i <= links_; ++i) {
            const auto& node = nodes_[i];
            const Pair velocity = at(node.velocity) * keep_, span = at(node.begun);
            const V error = dot(span, span) * node.per_length2 - number(1);
            const V growth = dot(span, velocity - before) * node.per_length2;
            strain = most(node.holds > V{} ? size_of(error) : error, strain);
            rate = most(pulls_only(node) ? (node.tension > V{} ? growth : V{}) : size_of(growth), rate);
            before = velocity;
        }
        const V longest = number(pack_.longest);
        const V unit =
            (strain > number(2 * crude) ? number(1) : V{}) + (rate * longest > number(usual_error) ? number(1) : V{});
        return of(pack_.fresh) * unit > V{};
    }

    void iterate(Mask& active, Mask& good) {
        active_at_start_ = active;
        const V near = of(pack_.reach) * number(hardly), near2 = near * near;
        for (int i = 0; i < most_iterations && any(active); ++i) {
            eliminate();
            substitute_back();
            const V worst = take_step(active);
            Mask done = both(active, both(both(worst <= number(exact), moved2_ <= near2), flipped_ <= V{}));
            if (!any(done)) continue;
            done = both(done, keeps_energy());
            good = good | done;
            active = without(active, done);
        }
    }

    /// Eliminates each node with the multiplier of its link, from the last to the first. With S the matrix of a node, N
    /// its inverse, g the geometric stiffness, a the direction of the force, e the link, and f the multiplier,
    ///
    ///     S d = r + g d_before - f a          e . (d - d_before) = -C
    ///     f = (C + e N r - q . d_before) / (e N a),   q = e - g N^T e,   p = a - g N a
    ///     S_before += g - g^2 N + p q^T / (e N a),    r_before += g N r + p (C + e N r) / (e N a)
    void eliminate() {
        Square<D, V> s{};
        Pair r{};
        const V half = number(0.5);
        for (int i = links_; i > 0; --i) {
            auto& node = nodes_[i];
            const Pair e = at(node.span), a = (at(node.begun) + e) * half;
            const V g = most(node.pull, V{}) * half; // none of a slack link, whose multiplier is zero
            r = r + (at(node.aim) - at(node.place)) * node.mass;
            s.add_to_diagonal(node.mass + g);
            V determinant;
            const auto n = adjugate(s, determinant);
            const Pair u = n * a, w = e * n, y = n * r;
            const V resistance = node.holds > V{} ? dot(e, u) : number(1),
                    both_inverse = number(1) / (determinant * resistance);
            const V per = resistance * both_inverse, stiffness = determinant * determinant * both_inverse * node.holds;
            const V gp = g * per;
            const Pair q = e - w * gp, p = (a - u * gp) * stiffness;
            const V error = (dot(e, e) - node.length2) * half + dot(w, r) * per;
            (y * per).to(node.move);
            (u * per).to(node.lever);
            q.to(node.across);
            node.error = error;
            node.stiffness = stiffness;
#pragma GCC unroll 3
            for (int k = 0; k < D; ++k)
#pragma GCC unroll 3
                for (int j = 0; j < D; ++j) {
                    const V carried = n.at[D * k + j] * gp;
                    node.carried[D * k + j] = carried;
                    s.at[D * k + j] = p.at[k] * q.at[j] - carried * g;
                }
            s.add_to_diagonal(g);
            r = at(node.move) * g + p * error;
        }
    }

    void substitute_back() {
        far2_ = moved2_ = V{};
        Pair d{};
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            const V f = (node.error - dot(at(node.across), d)) * node.stiffness;
            Square<D, V> carried;
#pragma GCC unroll 9
            for (int k = 0; k < D * D; ++k) carried.at[k] = node.carried[k];
            const Pair before = d;
            d = at(node.move) + carried * d - at(node.lever) * f;
            d.to(node.move);
            node.next = f;
            const Pair change = d - before;
            far2_ = most(dot(change, change) * node.per_length2, far2_);
            moved2_ = most(dot(d, d), moved2_);
        }
    }

    /// Newton step of the active lanes, within the trust region. Returns the worst error of a length, relative.
    V take_step(const Mask& active) {
        const V share = Base::trusted_share();
        V worst{};
        Pair before = at(nodes_[0].place);
        least_pull_ = number(1);
        flipped_ = tightened_ = V{};
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            Base::move(node.place, at(node.move) * share, active);
            node.pull = active ? node.pull + (node.next - node.pull) * share : node.pull;
            const Pair place = at(node.place), span = place - before;
            span.to(node.span);
            before = place;
            const V error = (dot(span, span) - node.length2) * node.per_length2;
            choose_side(node, error, active);
            worst = most(node.holds > V{} ? size_of(error) : error, worst);
            least_pull_ = pulls_only(node) ? least(node.pull, least_pull_) : least_pull_;
            tightened_ = both(both(pulls_only(node), node.tension <= V{}), node.pull > V{}) ? number(1) : tightened_;
        }
        return worst * number(0.5);
    }

    /// Releases a link that would push, unless it has become active too often, and activates a slack one that is too
    /// long: the active set of direct/multiplier_update.h. `error`: of the squared length, relative.
    void choose_side(Node& node, const V& error, const Mask& active) {
        constexpr double most_flips = 2, long_enough = 2e-7;
        const Mask may = both(active, pulls_only(node)), holds = node.holds > V{};
        const Mask released = both(both(may, holds), both(node.pull < -slight_, node.flips <= number(most_flips)));
        const Mask seized = both(without(may, holds), error > number(long_enough));
        node.holds = released ? V{} : seized ? number(1) : node.holds;
        node.pull = released ? V{} : node.pull;
        node.flips = seized ? node.flips + number(1) : node.flips;
        flipped_ = (released | seized) ? number(1) : flipped_;
    }

    /// Velocities at the end, and the lanes whose energy is right.
    Mask keeps_energy() {
        const V per = number(2) / h_;
        Pair before{}, carried{};
        V slip{};
        after_ = jolt_ = beyond_ = V{};
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            const Pair went = at(node.place) - at(node.start), velocity = went * per - at(node.velocity) * keep_;
            const Pair span = at(node.span), begun = at(node.begun);
            velocity.to(node.after);
            after_ = after_ + dot(velocity, velocity) * node.mass * number(0.5);
            carried = carried + went * node.mass;
            slip = slip + (dot(span, span) - dot(begun, begun)) * node.pull;
            jolt_ = most(size_of(dot(span, velocity - before)) * node.per_length2 * node.holds, jolt_);
            before = velocity;
            Base::measure_room(node.place);
        }
        return Base::conserves(carried, slip, before_ + after_, tightened_ > V{});
    }

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
        const V share = tightened ? number(1) : least(root(after_ / kinetic), number(fastest));
        for (int i = 1; i <= links_; ++i)
            for (int k = 0; k < D; ++k) nodes_[i].after[k] = struck ? nodes_[i].move[k] * share : nodes_[i].after[k];
        const Mask little = (after_ <= kinetic * number(much)) | tightened, shortest = of(pack_.shortest) > V{};
        good = without(good, without(without(struck, little), shortest));
        alien = both(good, undecided) ? number(1) : alien;
        good = without(good, undecided);
        lost = struck ? lost + (after_ - kinetic * share * share) : lost;
    }
    /// Velocities after the impulses, in `move`; returns the kinetic energy, J.
    V apply_impulses() {
        V kinetic{};
        Pair before_next{};
        for (int i = links_; i > 0; --i) {
            auto& node = nodes_[i];
            const Pair impulse = at(node.span) * node.next, kick = (before_next - impulse) * (number(1) / node.mass);
            const Pair velocity = at(node.after) + kick;
            velocity.to(node.move);
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
            const V growth = dot(at(node.span), at(node.move) - before) * node.per_length2 * number(pack_.longest);
            const Mask may = both(pulls_only(node), node.pull > V{}), holds = node.holds > V{};
            const Mask pushes = both(both(may, holds), node.next < V{});
            const Mask grows = both(without(may, holds), growth > number(exact));
            node.holds = pushes ? V{} : grows ? number(1) : node.holds;
            changed = (pushes | grows) ? number(1) : changed;
            before = at(node.move);
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

    void store_good(const Mask& good) {
        const V per = number(1) / (half_h2_ * of(pack_.yield));
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            for (int k = 0; k < D; ++k) {
                node.start[k] = good ? node.place[k] : node.start[k];
                node.velocity[k] = good ? node.after[k] : node.velocity[k];
            }
            node.tension = good ? (pulls_only(node) ? most(node.pull, V{}) : node.pull) * per : node.tension;
        }
    }
};

/// A substep of the chains of a pack, of `width` lanes.
template <int D, int width> void swing_chains(ChainPack<D>& pack) {
    ChainSwing<D, Pack<double, width>>(pack).run();
}

} // namespace
} // namespace sinew

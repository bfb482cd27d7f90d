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
          pulls_only_(of(pack.pulls_only) > V{}) {}

    void run() {
        Mask active = of(pack_.active) > V{};
        const Mask chosen = active, none = without(active, active);
        V alien{};
        set_out();
        active = without(active, unfit());
        Mask good = none;
        iterate(active, good);
        alien = without(chosen, active_at_start_) ? number(1) : alien;
        const Mask astray = both(good, both(pulls_only_, least_pull_ < V{}) | (beyond_ > V{}));
        good = without(good, astray);
        alien = astray ? number(1) : alien;
        const Mask tightened = both(pulls_only_, slackest_ <= V{});
        const Mask struck = both(good, (jolt_ * number(pack_.longest) > number(usual_error)) | tightened);
        V lost = most(due_ - after_, V{});
        if (any(struck)) straighten(struck, tightened, good, alien, lost);
        if (any(good)) store_good(good);
        Base::report(good, alien, lost);
    }

  private:
    ChainPack<D>& pack_;
    Node* nodes_;
    int links_;
    Mask pulls_only_;
    V slackest_{}; ///< least tension at the start, N/m

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
            before_ = before_ + dot(velocity, velocity) * node.mass * number(0.5);
        }
    }

    /// Lanes in a state that the midpoint rule does not start from: slack links, or at a fresh start lengths or
    /// velocities that are wrong.
    Mask unfit() {
        V slack{}, strain{}, rate{};
        slackest_ = number(1);
        Pair before{};
        for (int i = 1; i <= links_; ++i) {
            const auto& node = nodes_[i];
            const Pair velocity = at(node.velocity) * keep_, span = at(node.begun);
            const V length2 = dot(span, span) * node.per_length2;
            slackest_ = least(node.tension, slackest_);
            slack = node.tension > V{} ? slack : most(number(as_good_as_taut) - length2, slack);
            strain = most(size_of(length2 - number(1)), strain);
            rate = most(size_of(dot(span, velocity - before)) * node.per_length2, rate);
            before = velocity;
        }
        const V longest = number(pack_.longest);
        const V unit =
            (strain > number(2 * crude) ? number(1) : V{}) + (rate * longest > number(usual_error) ? number(1) : V{});
        return of(pack_.fresh) * unit + (pulls_only_ ? slack : V{}) > V{};
    }

    void iterate(Mask& active, Mask& good) {
        active_at_start_ = active;
        const V near = of(pack_.reach) * number(hardly), near2 = near * near;
        for (int i = 0; i < most_iterations && any(active); ++i) {
            eliminate();
            substitute_back();
            const V worst = take_step(active);
            Mask done = both(active, both(worst <= number(exact), moved2_ <= near2));
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
            const V g = most(node.pull, V{}) * half;
            r = r + (at(node.aim) - at(node.place)) * node.mass;
            s.add_to_diagonal(node.mass + g);
            V determinant;
            const auto n = adjugate(s, determinant);
            const Pair u = n * a, w = e * n, y = n * r;
            const V resistance = dot(e, u), both_inverse = number(1) / (determinant * resistance);
            const V per = resistance * both_inverse, stiffness = determinant * determinant * both_inverse;
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
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            Base::move(node.place, at(node.move) * share, active);
            node.pull = active ? node.pull + (node.next - node.pull) * share : node.pull;
            const Pair place = at(node.place), span = place - before;
            span.to(node.span);
            before = place;
            worst = most(size_of(dot(span, span) - node.length2) * node.per_length2, worst);
            least_pull_ = least(node.pull, least_pull_);
        }
        return worst * number(0.5);
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
            jolt_ = most(size_of(dot(span, velocity - before)) * node.per_length2, jolt_);
            before = velocity;
            Base::measure_room(node.place);
        }
        return Base::conserves(carried, slip, before_ + after_);
    }

    /// Removes velocities along the links, an error of the midpoint rule after the crack of a whip, and gives their
    /// energy back to the allowed motion; that of a link that has just become taut is lost. Multipliers f solve a
    /// tridiagonal system, e_i . (v_i - v_before) = 0:
    ///
    ///     v_i += (f_next e_next - f_i e_i) / m_i
    void straighten(const Mask& struck, const Mask& tightened, Mask& good, V& alien, V& lost) {
        solve_tridiagonal();
        V least_impulse = number(1), kinetic{};
        Pair before_next{};
        for (int i = links_; i > 0; --i) {
            auto& node = nodes_[i];
            const Pair impulse = at(node.span) * node.next, kick = (before_next - impulse) * (number(1) / node.mass);
            const Pair velocity = at(node.after) + kick;
            velocity.to(node.move);
            kinetic = kinetic + dot(velocity, velocity) * node.mass * number(0.5);
            least_impulse = least(node.next, least_impulse);
            before_next = impulse;
        }
        constexpr double fastest = 1.1, much = 1.02;
        const V share = tightened ? number(1) : least(root(after_ / kinetic), number(fastest));
        for (int i = 1; i <= links_; ++i)
            for (int k = 0; k < D; ++k) nodes_[i].after[k] = struck ? nodes_[i].move[k] * share : nodes_[i].after[k];
        const Mask little = (after_ <= kinetic * number(much)) | tightened, shortest = of(pack_.shortest) > V{};
        const Mask slack = both(struck, both(pulls_only_, least_impulse < V{}));
        good = without(good, without(without(struck, little), shortest));
        alien = both(good, slack) ? number(1) : alien;
        good = without(good, slack);
        lost = struck ? lost + (after_ - kinetic * share * share) : lost;
    }
    void solve_tridiagonal() {
        V lighter{}, side{}, right{}, ratio{}; // of the node before: 1 / mass, and the eliminated row
        Pair velocity_before{}, span_before{};
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            const Pair span = at(node.span), velocity = at(node.after);
            const V mobility = number(1) / node.mass;
            side = -dot(span_before, span) * lighter;
            const V pivot = dot(span, span) * (lighter + mobility) - side * ratio;
            right = (dot(span, velocity - velocity_before) - side * right) / pivot;
            node.error = right;
            const Pair next = i < links_ ? at(nodes_[i + 1].span) : Pair{};
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
            node.tension = good ? node.pull * per : node.tension;
        }
    }
};

/// A substep of the chains of a pack, of `width` lanes.
template <int D, int width> void swing_chains(ChainPack<D>& pack) {
    ChainSwing<D, Pack<double, width>>(pack).run();
}

} // namespace
} // namespace sinew

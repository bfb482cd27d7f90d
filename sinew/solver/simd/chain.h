#pragma once

#include "sinew/solver/simd/chain_impulses.h"

/// Kernel of chains: a substep by the midpoint rule, as direct/newton.h has it, for chains side by side in lanes.
namespace sinew {
namespace {

template <int D, class V> class ChainSwing : ChainImpulses<D, V> {
    using Base = LaneSwing<D, V>;
    using Equations = ChainEquations<D, V>;
    using Impulses = ChainImpulses<D, V>;
    using Base::active_at_start_, Base::moved2_, Base::before_, Base::after_, Base::due_, Base::jolt_, Base::beyond_;
    using Base::number, Base::of, Base::at, Base::h_, Base::keep_, Base::half_h2_, Base::min_pull_;
    using Base::usual_error, Base::exact, Base::hardly, Base::crude, Base::as_good_as_taut, Base::max_iterations;
    using Equations::pack_, Equations::nodes_, Equations::links_, Equations::slight_, Equations::flipped_;
    using Equations::take_step;
    using Equations::tightened_, Equations::pulls_only, Equations::eliminate, Equations::substitute_back;
    using Impulses::straighten;
    using typename Base::Mask;
    using typename Base::Pair;

  public:
    using Node = ChainNode<D, V>;

    explicit ChainSwing(ChainPack<D>& pack) : Impulses(pack) {}

    void run() {
        Mask active = of(pack_.active) > V{};
        const Mask chosen = active, none = without(active, active);
        V alien{};
        set_out();
        active = without(active, unfit());
        Mask good = none;
        iterate(active, good);
        alien = without(chosen, active_at_start_) ? number(1) : alien;
        const Mask astray = both(good, (min_pull_ < -slight_) | (beyond_ > V{}));
        good = without(good, astray);
        alien = astray ? number(1) : alien;
        const Mask struck = both(good, (jolt_ * number(pack_.longest) > number(usual_error)) | (tightened_ > V{}));
        V lost = max(due_ - after_, V{});
        if (any(struck)) straighten(struck, good, alien, lost);
        if (any(good)) store_good(good);
        Base::report(good, alien, lost);
    }

  private:
    /// Free flight, and the tensions of the last substep.
    void set_out() {
        const V unit = half_h2_ * of(pack_.yield);
        const Pair fall = Base::acceleration() * half_h2_;
        at(nodes_[0].start).to(nodes_[0].position);
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            const Pair start = at(node.start), velocity = at(node.velocity) * keep_, position = start + velocity * h_;
            position.to(node.position);
            (position + fall).to(node.predicted);
            (start - at(nodes_[i - 1].start)).to(node.begun);
            (position - at(nodes_[i - 1].position)).to(node.span);
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
            strain = max(node.holds > V{} ? size_of(error) : error, strain);
            rate = max(pulls_only(node) ? (node.tension > V{} ? growth : V{}) : size_of(growth), rate);
            before = velocity;
        }
        const V longest = number(pack_.longest);
        const V unit =
            (strain > number(2 * crude) ? number(1) : V{}) + (rate * longest > number(usual_error) ? number(1) : V{});
        return of(pack_.fresh) * unit > V{};
    }

    void iterate(Mask& active, Mask& good) {
        active_at_start_ = active;
        const V near = of(pack_.total_length) * number(hardly), near2 = near * near;
        for (int i = 0; i < max_iterations && any(active); ++i) {
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

    /// Velocities at the end, and the lanes whose energy is right.
    Mask keeps_energy() {
        const V per = number(2) / h_;
        Pair before{}, carried{};
        V slip{};
        after_ = jolt_ = beyond_ = V{};
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            const Pair went = at(node.position) - at(node.start), velocity = went * per - at(node.velocity) * keep_;
            const Pair span = at(node.span), begun = at(node.begun);
            velocity.to(node.after);
            after_ = after_ + dot(velocity, velocity) * node.mass * number(0.5);
            carried = carried + went * node.mass;
            slip = slip + (dot(span, span) - dot(begun, begun)) * node.pull;
            jolt_ = max(size_of(dot(span, velocity - before)) * node.per_length2 * node.holds, jolt_);
            before = velocity;
            Base::measure_room(node.position);
        }
        return Base::conserves(carried, slip, before_ + after_, tightened_ > V{});
    }

    void store_good(const Mask& good) {
        const V per = number(1) / (half_h2_ * of(pack_.yield));
        for (int i = 1; i <= links_; ++i) {
            auto& node = nodes_[i];
            for (int k = 0; k < D; ++k) {
                node.start[k] = good ? node.position[k] : node.start[k];
                node.velocity[k] = good ? node.after[k] : node.velocity[k];
            }
            node.tension = good ? (pulls_only(node) ? max(node.pull, V{}) : node.pull) * per : node.tension;
        }
    }
};

/// A substep of the chains of a pack, of `width` lanes.
template <int D, int width> void swing_chains(ChainPack<D>& pack) {
    ChainSwing<D, Pack<double, width>>(pack).run();
}

} // namespace
} // namespace sinew

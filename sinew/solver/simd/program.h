#pragma once

#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/lane_spin.h"
#include "sinew/solver/simd/program_equations.h"

/// Kernel of small sparse blocks: a substep by the midpoint rule, as direct/newton.h has it, for blocks of one program
/// side by side in lanes.
namespace sinew {
namespace {

template <int D, class V> class ProgramSwing : ProgramEquations<D, V> {
    using Equations = ProgramEquations<D, V>;
    using Base = LaneSwing<D, V>;
    using Base::active_at_start_, Base::moved2_, Base::before_, Base::after_, Base::due_, Base::jolt_;
    using Base::number, Base::of, Base::at, Base::h_, Base::keep_, Base::half_h2_, Base::min_pull_, Base::beyond_;
    using Base::usual_error, Base::exact, Base::hardly, Base::crude, Base::max_iterations;
    using Equations::assemble, Equations::eliminate, Equations::substitute_back, Equations::take_step;
    using Equations::pack_, Equations::program_, Equations::nodes_, Equations::links_, Equations::planes_;
    using Equations::relative;
    using typename Base::Mask;
    using typename Base::Pair;

  public:
    using Node = ProgramNode<D, V>;
    using Limit = ProgramLimit<V>;

    explicit ProgramSwing(ProgramPack<D>& pack)
        : Equations(pack), limits_(reinterpret_cast<const Limit*>(pack.limits)) {}

    void run() {
        Mask active = of(pack_.active) > V{};
        const Mask chosen = active;
        Mask good = without(active, active);
        set_out();
        active = without(active, unfit());
        iterate(active, good);
        const V jolt = jolt_ * number(pack_.longest) - number(usual_error);
        const V astray = max(max(-min_pull_, beyond_), jolt), at_limit = beyond_limits<&Node::position>();
        const Mask at_once = max(number(overshoot) - at_limit, of(pack_.shortest)) > V{};
        V alien = without(chosen, active_at_start_) ? number(1) : V{};
        alien = both(good, astray > V{}) ? number(1) : alien;
        alien = both(both(good, at_once), at_limit > V{}) ? number(1) : alien;
        good = without(good, max(astray, at_limit) > V{});
        if (pack_.is_free && any(good)) keep_spin();
        if (any(good)) store_good(good);
        Base::report(good, alien, max(due_ - after_, V{}));
    }

  private:
    static constexpr double overshoot = 2e-3; ///< beyond a limit, from which a joint bounces at once
    /// Last move of a node of a free block, relative to the total length. The next would be rounding: no decision may
    /// depend on how fast the whole flies.
    static constexpr double precise = 1e-9;

    const Limit* limits_;
    Pair momentum_{};

    // --- a substep's start

    /// Free flight, and the tensions of the last substep.
    void set_out() {
        const Pair fall = Base::acceleration() * half_h2_;
        for (std::uint32_t i = 0; i < program_.nodes; ++i) {
            auto& node = nodes_[i];
            const Pair start = at(node.start);
            if (i >= program_.unknowns) {
                start.to(node.position);
                Pair{}.to(node.displacement);
                continue;
            }
            const Pair velocity = at(node.velocity) * keep_, position = start + velocity * h_;
            position.to(node.position);
            (position + fall).to(node.predicted);
            before_ = before_ + dot(velocity, velocity) * node.mass * number(0.5);
            momentum_ = momentum_ + velocity * node.mass;
        }
        begin_rows();
    }
    void begin_rows() {
        const V unit = half_h2_ * of(pack_.yield), hardest = of(pack_.total) * number(relative);
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            auto& link = links_[j];
            this->template span_of<&Node::start>(program_.link[j]).to(link.begun);
            this->template span_of<&Node::position>(program_.link[j]).to(link.span);
            link.pull = link.tension * unit;
            link.stiffness = hardest * link.per_length2;
        }
        if constexpr (D == 3)
            for (std::uint32_t j = 0; j < program_.planes; ++j) {
                auto& plane = planes_[j];
                plane.begun = this->template volume_of<&Node::start>(program_.plane[j].nodes) * plane.per_unit;
                plane.pull = plane.tension * unit;
            }
    }

    /// Lanes in a state that the midpoint rule does not start from: slack links, limits reached, or at a fresh start
    /// lengths or velocities that are wrong.
    Mask unfit() {
        V slack{}, strain{}, rate{};
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            const auto& row = program_.link[j];
            const auto& link = links_[j];
            const Pair span = at(link.begun);
            strain = max(size_of(dot(span, span) * link.per_length2 - number(1)), strain);
            rate = max(size_of(dot(span, speed_of(row.b) - speed_of(row.a))) * link.per_length2, rate);
            if (row.pulls_only) slack = link.tension > V{} ? slack : number(1);
        }
        for (std::uint32_t j = 0; j < program_.planes; ++j) strain = max(size_of(planes_[j].begun) * number(2), strain);
        const V wrong = (strain > number(2 * crude) ? number(1) : V{}) +
                        (rate * number(pack_.longest) > number(usual_error) ? number(1) : V{});
        V loaded{};
        for (std::uint32_t j = 0; j < program_.ranges + program_.folds; ++j)
            loaded = max(size_of(limits_[j].tension), loaded);
        return of(pack_.fresh) * wrong + slack + loaded + max(beyond_limits<&Node::start>(), V{}) > V{};
    }
    Pair speed_of(std::uint32_t i) const { return i < program_.unknowns ? at(nodes_[i].velocity) * keep_ : Pair{}; }
    /// Largest excess over the limits of ranges and folds, in their units; positive outside.
    template <auto where> V beyond_limits() const {
        V beyond = number(-1);
        const auto examine = [&](const Limit& limit, const V& value) {
            beyond = max(max(limit.low - value, value - limit.high) * limit.per_unit, beyond);
        };
        for (std::uint32_t j = 0; j < program_.ranges; ++j) {
            const Pair span = this->template span_of<where>(program_.range[j]);
            examine(limits_[j], dot(span, span));
        }
        if constexpr (D == 3)
            for (std::uint32_t j = 0; j < program_.folds; ++j)
                examine(limits_[program_.ranges + j], this->template volume_of<where>(program_.fold[j].nodes));
        return beyond;
    }

    // --- Newton's method

    void iterate(Mask& active, Mask& good) {
        active_at_start_ = active;
        for (int i = 0; i < max_iterations && any(active); ++i) {
            assemble();
            eliminate();
            substitute_back();
            const V worst = take_step(active);
            Mask done = both(active, both(worst <= number(exact), is_steady()));
            if (!any(done)) continue;
            done = both(done, keeps_energy());
            good = good | done;
            active = without(active, done);
        }
    }
    Mask is_steady() const {
        const V near = of(pack_.total_length) * number(pack_.is_free ? precise : hardly);
        return moved2_ <= near * near;
    }

    // --- a substep's end

    /// Velocities at the end, and the lanes whose energy is right. That of a free block as a whole does not count.
    Mask keeps_energy() {
        const V per = number(2) / h_;
        Pair carried{}, momentum{};
        after_ = jolt_ = beyond_ = V{};
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            auto& node = nodes_[i];
            const Pair went = at(node.position) - at(node.start), velocity = went * per - at(node.velocity) * keep_;
            velocity.to(node.after);
            after_ = after_ + dot(velocity, velocity) * node.mass * number(0.5);
            carried = carried + went * node.mass;
            momentum = momentum + velocity * node.mass;
            Base::measure_room(node.position);
        }
        V slip{};
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            const auto& link = links_[j];
            const auto& row = program_.link[j];
            const Pair span = at(link.span), begun = at(link.begun);
            const auto end = [&](std::uint32_t i) { return i < program_.unknowns ? at(nodes_[i].after) : Pair{}; };
            slip = slip + (dot(span, span) - dot(begun, begun)) * link.pull;
            jolt_ = max(size_of(dot(span, end(row.b) - end(row.a))) * link.per_length2, jolt_);
        }
        for (std::uint32_t j = 0; j < program_.planes; ++j)
            slip = slip + (planes_[j].volume - planes_[j].begun) * planes_[j].pull * number(2);
        V inner = before_ + after_;
        if (pack_.is_free)
            inner = inner - (dot(momentum_, momentum_) + dot(momentum, momentum)) * number(0.5) / of(pack_.total);
        return Base::conserves(carried, slip, inner);
    }

    /// Restores the angular momentum of a free block, which gravity does not change: the last iteration has turned the
    /// links a little further than their forces.
    void keep_spin() {
        const Pair begun = center_of<&Node::start>(), center = center_of<&Node::position>();
        Spin<D, V> missing{};
        Inertia<D, V> inertia;
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            const auto& node = nodes_[i];
            const Pair arm = at(node.position) - center;
            const auto before = moment(at(node.start) - begun, at(node.velocity) * keep_);
            missing = missing + (before - moment(arm, at(node.after))) * node.mass;
            inertia.add(arm, node.mass);
        }
        const auto rate = inertia.rate_of(missing);
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            auto& node = nodes_[i];
            (at(node.after) + turning(rate, at(node.position) - center)).to(node.after);
        }
    }
    template <auto where> Pair center_of() const {
        Pair sum{};
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) sum = sum + at(nodes_[i].*where) * nodes_[i].mass;
        return sum * (number(1) / of(pack_.total));
    }

    void store_good(const Mask& good) {
        const V per = number(1) / (half_h2_ * of(pack_.yield));
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            auto& node = nodes_[i];
            for (int k = 0; k < D; ++k) {
                node.start[k] = good ? node.position[k] : node.start[k];
                node.velocity[k] = good ? node.after[k] : node.velocity[k];
            }
        }
        for (std::uint32_t j = 0; j < program_.links; ++j)
            links_[j].tension = good ? links_[j].pull * per : links_[j].tension;
        for (std::uint32_t j = 0; j < program_.planes; ++j)
            planes_[j].tension = good ? planes_[j].pull * per : planes_[j].tension;
    }
};

/// A substep of the blocks of a pack, of `width` lanes.
template <int D, int width> void swing_programs(ProgramPack<D>& pack) {
    ProgramSwing<D, Pack<double, width>>(pack).run();
}

} // namespace
} // namespace sinew

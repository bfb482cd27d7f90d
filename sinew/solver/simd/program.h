#pragma once

#include "sinew/solver/simd/kernel.h"
#include "sinew/solver/simd/lane_spin.h"
#include "sinew/solver/simd/lane_swing.h"

/// Kernel of small sparse blocks: a substep by the midpoint rule, as direct/newton.h has it, for blocks of one program
/// side by side in lanes.
namespace sinew {
namespace {

template <int D, class V> class ProgramSwing : LaneSwing<D, V> {
    using Base = LaneSwing<D, V>;
    using Base::active_at_start_, Base::far2_, Base::moved2_, Base::before_, Base::after_, Base::due_, Base::jolt_;
    using Base::number, Base::of, Base::at, Base::h_, Base::keep_, Base::half_h2_, Base::least_pull_, Base::beyond_;
    using Base::usual_error, Base::exact, Base::hardly, Base::crude, Base::most_iterations;
    using typename Base::Mask;
    using typename Base::Pair;

  public:
    using Node = ProgramNode<D, V>;
    using Link = ProgramLink<D, V>;
    using Plane = ProgramPlane<D, V>;
    using Limit = ProgramLimit<V>;
    using Entry = ProgramEntry<D, V>;

    explicit ProgramSwing(ProgramPack<D>& pack)
        : Base(pack), pack_(pack), program_(pack.program), nodes_(reinterpret_cast<Node*>(pack.nodes)),
          links_(reinterpret_cast<Link*>(pack.links)), planes_(reinterpret_cast<Plane*>(pack.planes)),
          limits_(reinterpret_cast<const Limit*>(pack.limits)), entries_(reinterpret_cast<Entry*>(pack.entries)) {}

    void run() {
        Mask active = of(pack_.active) > V{};
        const Mask chosen = active;
        Mask good = without(active, active);
        set_out();
        active = without(active, unfit());
        iterate(active, good);
        const V jolt = jolt_ * number(pack_.longest) - number(usual_error);
        const V astray = most(most(-least_pull_, beyond_), jolt), at_limit = beyond_limits<&Node::place>();
        const Mask at_once = most(number(overshoot) - at_limit, of(pack_.shortest)) > V{};
        V alien = without(chosen, active_at_start_) ? number(1) : V{};
        alien = both(good, astray > V{}) ? number(1) : alien;
        alien = both(both(good, at_once), at_limit > V{}) ? number(1) : alien;
        good = without(good, most(astray, at_limit) > V{});
        if (pack_.is_free && any(good)) keep_spin();
        if (any(good)) store_good(good);
        Base::report(good, alien, most(due_ - after_, V{}));
    }

  private:
    using Matrix = Square<D, V>;
    static constexpr double relative = 0.5e4;   ///< penalty of a link, over total mass / length^2
    static constexpr double small_angle = 1e-2; ///< error of a plane that counts as this fraction of a length's
    static constexpr double overshoot = 2e-3;   ///< beyond a limit, from which a joint bounces at once
    /// Last move of a node of a free block, relative to the total length. The next would be rounding: no decision may
    /// depend on how fast the whole flies.
    static constexpr double precise = 1e-9;

    ProgramPack<D>& pack_;
    const BlockProgram& program_;
    Node* nodes_;
    Link* links_;
    Plane* planes_;
    const Limit* limits_;
    Entry* entries_;
    Pair momentum_{};

    // --- a substep's start

    /// Free flight, and the tensions of the last substep.
    void set_out() {
        const Pair fall = Base::push() * half_h2_;
        for (std::uint32_t i = 0; i < program_.nodes; ++i) {
            auto& node = nodes_[i];
            const Pair start = at(node.start);
            if (i >= program_.unknowns) {
                start.to(node.place);
                Pair{}.to(node.move);
                continue;
            }
            const Pair velocity = at(node.velocity) * keep_, place = start + velocity * h_;
            place.to(node.place);
            (place + fall).to(node.aim);
            before_ = before_ + dot(velocity, velocity) * node.mass * number(0.5);
            momentum_ = momentum_ + velocity * node.mass;
        }
        begin_rows();
    }
    void begin_rows() {
        const V unit = half_h2_ * of(pack_.yield), hardest = of(pack_.total) * number(relative);
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            auto& link = links_[j];
            span_of<&Node::start>(program_.link[j]).to(link.begun);
            span_of<&Node::place>(program_.link[j]).to(link.span);
            link.pull = link.tension * unit;
            link.stiffness = hardest * link.per_length2;
        }
        if constexpr (D == 3)
            for (std::uint32_t j = 0; j < program_.planes; ++j) {
                auto& plane = planes_[j];
                plane.begun = volume_of<&Node::start>(program_.plane[j].nodes) * plane.per_unit;
                plane.pull = plane.tension * unit;
            }
    }

    template <auto where, class Row> Pair span_of(const Row& row) const {
        return at(nodes_[row.b].*where) - at(nodes_[row.a].*where);
    }
    /// Volume of a tetrahedron, as constraint/volume.h has it.
    template <auto where> V volume_of(const std::uint32_t (&corners)[4]) const requires(D == 3) {
        const Pair a = at(nodes_[corners[0]].*where);
        const auto edge = [&](int k) { return at(nodes_[corners[k]].*where) - a; };
        return dot(edge(1), cross(edge(2), edge(3))) * number(1.0 / 6);
    }

    /// Lanes in a state that the midpoint rule does not start from: slack links, limits reached, or at a fresh start
    /// lengths or velocities that are wrong.
    Mask unfit() {
        V slack{}, strain{}, rate{};
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            const auto& row = program_.link[j];
            const auto& link = links_[j];
            const Pair span = at(link.begun);
            strain = most(size_of(dot(span, span) * link.per_length2 - number(1)), strain);
            rate = most(size_of(dot(span, speed_of(row.b) - speed_of(row.a))) * link.per_length2, rate);
            if (row.pulls_only) slack = link.tension > V{} ? slack : number(1);
        }
        for (std::uint32_t j = 0; j < program_.planes; ++j)
            strain = most(size_of(planes_[j].begun) * number(2), strain);
        const V wrong = (strain > number(2 * crude) ? number(1) : V{}) +
                        (rate * number(pack_.longest) > number(usual_error) ? number(1) : V{});
        V loaded{};
        for (std::uint32_t j = 0; j < program_.ranges + program_.folds; ++j)
            loaded = most(size_of(limits_[j].tension), loaded);
        return of(pack_.fresh) * wrong + slack + loaded + most(beyond_limits<&Node::start>(), V{}) > V{};
    }
    Pair speed_of(std::uint32_t i) const { return i < program_.unknowns ? at(nodes_[i].velocity) * keep_ : Pair{}; }
    /// Largest excess over the limits of ranges and folds, in their units; positive outside.
    template <auto where> V beyond_limits() const {
        V beyond = number(-1);
        const auto look = [&](const Limit& limit, const V& value) {
            beyond = most(most(limit.low - value, value - limit.high) * limit.per_unit, beyond);
        };
        for (std::uint32_t j = 0; j < program_.ranges; ++j) {
            const Pair span = span_of<where>(program_.range[j]);
            look(limits_[j], dot(span, span));
        }
        if constexpr (D == 3)
            for (std::uint32_t j = 0; j < program_.folds; ++j)
                look(limits_[program_.ranges + j], volume_of<where>(program_.fold[j].nodes));
        return beyond;
    }

    // --- Newton's method

    void iterate(Mask& active, Mask& good) {
        active_at_start_ = active;
        for (int i = 0; i < most_iterations && any(active); ++i) {
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
        const V near = of(pack_.reach) * number(pack_.is_free ? precise : hardly);
        return moved2_ <= near * near;
    }

    void assemble() {
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            auto& node = nodes_[i];
            Matrix diagonal{};
            diagonal.add_to_diagonal(node.mass);
            diagonal.to(node.diagonal);
            ((at(node.aim) - at(node.place)) * node.mass).to(node.residual);
        }
        for (std::uint32_t e = 0; e < program_.entries; ++e) {
            Matrix{}.to(entries_[e].lower);
            Matrix{}.to(entries_[e].upper);
        }
        for (std::uint32_t j = 0; j < program_.links; ++j) add(program_.link[j], links_[j]);
        if constexpr (D == 3)
            for (std::uint32_t j = 0; j < program_.planes; ++j) add(program_.plane[j], planes_[j]);
    }
    void add(const BlockProgram::Link& row, Link& link) {
        const Pair e = at(link.span), along = (at(link.begun) + e) * number(0.5);
        link.next = link.pull + link.stiffness * (dot(e, e) - link.length2) * number(0.5);
        Matrix stiffness = outer(along * link.stiffness, e);
        stiffness.add_to_diagonal(most(link.pull, V{}) * number(0.5));
        const Pair force = along * link.next;
        if (row.a < program_.unknowns) push(row.a, stiffness, force);
        if (row.b < program_.unknowns) push(row.b, stiffness, Pair{} - force);
        if (row.entry == BlockProgram::none) return;
        stiffness.take_from(entries_[row.entry].lower);
        stiffness.take_from(entries_[row.entry].upper);
    }
    void push(std::uint32_t i, const Matrix& stiffness, const Pair& force) {
        stiffness.add_to(nodes_[i].diagonal);
        (at(nodes_[i].residual) + force).to(nodes_[i].residual);
    }

    /// A plane, along the mean gradient over the substep, exact since a volume is linear in each edge
    /// (direct/angle_rows.h).
    void add(const BlockProgram::Plane& row, Plane& plane) requires(D == 3) {
        Pair begun[4], edge[4], along[4], gradient[4];
        for (int k = 1; k < 4; ++k) {
            begun[k] = at(nodes_[row.nodes[k]].start) - at(nodes_[row.nodes[0]].start);
            edge[k] = at(nodes_[row.nodes[k]].place) - at(nodes_[row.nodes[0]].place);
        }
        const auto mean = [&](int i, int j) {
            return (cross(begun[i] * number(2) + edge[i], begun[j]) + cross(edge[i] * number(2) + begun[i], edge[j])) *
                   (plane.per_unit * number(1.0 / 36));
        };
        const auto now = [&](int i, int j) { return cross(edge[i], edge[j]) * (plane.per_unit * number(1.0 / 6)); };
        along[1] = mean(2, 3), along[2] = mean(3, 1), along[3] = mean(1, 2);
        along[0] = Pair{} - (along[1] + along[2] + along[3]);
        gradient[1] = now(2, 3), gradient[2] = now(3, 1), gradient[3] = now(1, 2);
        gradient[0] = Pair{} - (gradient[1] + gradient[2] + gradient[3]);
        V steepest2{};
        for (int k = 0; k < 4; ++k) {
            gradient[k].to(plane.gradient[k]);
            steepest2 = most(dot(gradient[k], gradient[k]), steepest2);
        }
        plane.volume = dot(edge[1], gradient[1]);
        plane.stiffness = of(pack_.total) * number(relative) / steepest2;
        plane.next = plane.pull + plane.stiffness * plane.volume;
        for (int i = 0, pair = 0; i < 4; ++i) {
            const Pair stiff = along[i] * plane.stiffness;
            push(row.nodes[i], outer(stiff, gradient[i]), Pair{} - along[i] * plane.next);
            for (int j = i + 1; j < 4; ++j, ++pair) {
                auto& entry = entries_[row.entries[pair]];
                outer(along[j] * plane.stiffness, gradient[i]).add_to(entry.lower);
                outer(stiff, gradient[j]).add_to(entry.upper);
            }
        }
    }

    /// LU by D x D blocks, as in direct/matrices.h.
    void eliminate() {
        const std::uint32_t* pair = program_.pairs;
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            auto& node = nodes_[i];
            V determinant;
            const Matrix adjoint = adjugate(Matrix::of(node.diagonal), determinant);
            const Matrix inverse = adjoint * (number(1) / determinant);
            inverse.to(node.diagonal);
            const Pair y = inverse * at(node.residual);
            y.to(node.move);
            const auto end = program_.first_entry[i + 1];
            for (auto e = program_.first_entry[i]; e < end; ++e) {
                const Matrix lower = Matrix::of(entries_[e].lower), right = inverse * Matrix::of(entries_[e].upper);
                auto& other = nodes_[program_.entry_node[e]];
                (lower * right).take_from(other.diagonal);
                (at(other.residual) - lower * y).to(other.residual);
                if (e + 1 == end) continue;
                const Matrix down = lower * inverse;
                for (auto g = e + 1; g < end; ++g) {
                    auto& filled = entries_[*pair++];
                    (Matrix::of(entries_[g].lower) * right).take_from(filled.lower);
                    (down * Matrix::of(entries_[g].upper)).take_from(filled.upper);
                }
            }
        }
    }
    void substitute_back() {
        moved2_ = V{};
        for (auto i = program_.unknowns; i-- > 0;) {
            auto& node = nodes_[i];
            Pair pulled{};
            for (auto e = program_.first_entry[i]; e < program_.first_entry[i + 1]; ++e)
                pulled = pulled + Matrix::of(entries_[e].upper) * at(nodes_[program_.entry_node[e]].move);
            const Pair move = at(node.move) - Matrix::of(node.diagonal) * pulled;
            move.to(node.move);
            moved2_ = most(dot(move, move), moved2_);
        }
    }

    /// Newton step of the active lanes, within the trust region. Returns the worst error of a row, relative.
    V take_step(const Mask& active) {
        far2_ = V{};
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            auto& link = links_[j];
            const Pair change = span_of<&Node::move>(program_.link[j]);
            far2_ = most(dot(change, change) * link.per_length2, far2_);
            link.next = link.next + link.stiffness * dot(at(link.span), change);
        }
        const V share = Base::trusted_share();
        for (std::uint32_t i = 0; i < program_.unknowns; ++i)
            Base::move(nodes_[i].place, at(nodes_[i].move) * share, active);
        V worst{};
        least_pull_ = number(1);
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            auto& link = links_[j];
            const Pair span = span_of<&Node::place>(program_.link[j]);
            span.to(link.span);
            link.pull = active ? link.pull + (link.next - link.pull) * share : link.pull;
            if (program_.link[j].pulls_only) least_pull_ = least(link.pull, least_pull_);
            worst = most(size_of(dot(span, span) - link.length2) * link.per_length2 * number(0.5), worst);
        }
        if constexpr (D == 3) worst = most(step_planes(active, share) * number(small_angle), worst);
        return worst;
    }
    V step_planes(const Mask& active, const V& share) requires(D == 3) {
        V worst{};
        for (std::uint32_t j = 0; j < program_.planes; ++j) {
            auto& plane = planes_[j];
            const auto& corners = program_.plane[j].nodes;
            V change{};
            for (int k = 0; k < 4; ++k) change = change + dot(at(plane.gradient[k]), at(nodes_[corners[k]].move));
            const V next = plane.next + plane.stiffness * change;
            plane.pull = active ? plane.pull + (next - plane.pull) * share : plane.pull;
            plane.volume = volume_of<&Node::place>(corners) * plane.per_unit;
            worst = most(size_of(plane.volume), worst);
        }
        return worst;
    }

    // --- a substep's end

    /// Velocities at the end, and the lanes whose energy is right. That of a free block as a whole does not count.
    Mask keeps_energy() {
        const V per = number(2) / h_;
        Pair carried{}, momentum{};
        after_ = jolt_ = beyond_ = V{};
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            auto& node = nodes_[i];
            const Pair went = at(node.place) - at(node.start), velocity = went * per - at(node.velocity) * keep_;
            velocity.to(node.after);
            after_ = after_ + dot(velocity, velocity) * node.mass * number(0.5);
            carried = carried + went * node.mass;
            momentum = momentum + velocity * node.mass;
            Base::measure_room(node.place);
        }
        V slip{};
        for (std::uint32_t j = 0; j < program_.links; ++j) {
            const auto& link = links_[j];
            const auto& row = program_.link[j];
            const Pair span = at(link.span), begun = at(link.begun);
            const auto end = [&](std::uint32_t i) { return i < program_.unknowns ? at(nodes_[i].after) : Pair{}; };
            slip = slip + (dot(span, span) - dot(begun, begun)) * link.pull;
            jolt_ = most(size_of(dot(span, end(row.b) - end(row.a))) * link.per_length2, jolt_);
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
        const Pair begun = center_of<&Node::start>(), center = center_of<&Node::place>();
        Spin<D, V> missing{};
        Inertia<D, V> inertia;
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            const auto& node = nodes_[i];
            const Pair arm = at(node.place) - center;
            const auto before = moment(at(node.start) - begun, at(node.velocity) * keep_);
            missing = missing + (before - moment(arm, at(node.after))) * node.mass;
            inertia.add(arm, node.mass);
        }
        const auto rate = inertia.rate_of(missing);
        for (std::uint32_t i = 0; i < program_.unknowns; ++i) {
            auto& node = nodes_[i];
            (at(node.after) + turning(rate, at(node.place) - center)).to(node.after);
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
                node.start[k] = good ? node.place[k] : node.start[k];
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

#pragma once

#include "sinew/assert/assert.h"
#include "sinew/solver/direct/chord.h"
#include "sinew/solver/ports/port_response.h"
#include "sinew/solver/solver.h"
#include "sinew/world/world.h"

/// A block with ports, in one substep. Before the sweep the block is solved with the impulses of the last substep at
/// the ports; during the sweep the ports are linear about this solution; afterwards the block takes the new impulses.
///
/// Links pull along their new directions: maximum lengths form a convex set, and a projection onto a convex set adds no
/// energy. Old directions (SHAKE) keep the energy of a swing, but the pulls of a sweep are no smooth forces, and errors
/// left by one substep and repaired by the next would add up.
namespace sinew::detail {

template <int D, class Real> class PortBlock {
  public:
    using Vector = Vec<D, double>;

    PortBlock(World<D, Real>& world, Solver<D, Real>& solver, Block& block, Real h)
        : swept_(solver.sweep_state), distances_(std::get<kind_number<Distance, D>>(world.constraints)),
          angles_(std::get<kind_number<Angle, D>>(world.constraints)), blocks_(solver.blocks), block_(block),
          h_(double(h)) {}

    std::span<Port<D>> ports() const { return std::span(blocks_.ports.list).subspan(block_.first_port, block_.ports); }

    /// Linear about the guessed impulses.
    void predict() {
        for (auto& link : links()) link.slackened = false;
        for (auto& port : ports()) port.impulse = port.guess;
        start_tensions();
        if (solve_by_chord()) {
            note_slack();
        } else {
            start_tensions();
            solve();
            factorise(Held::as_solved);
        }
        find_free_moves();
    }
    /// Once more, linear about no impulse, with an upper bound of the mobility.
    void predict_loosely() {
        for (auto& port : ports()) port.impulse = {};
        start_tensions();
        solve();
        factorise(Held::at_least);
        block_.is_factorised = false;
        find_free_moves();
    }

    /// Places of the ports before the sweep. Only the sweep's impulses move the block from here on.
    void show() {
        for (auto& node : unknowns()) swept_.mobility[slot(node)] = 0;
        for (auto& port : ports()) {
            port.impulse = {};
            const auto move = clamp_components(port.free_move, furthest());
            swept_.set_move(slot(blocks_.nodes[port.node]), cast<Real>(move));
        }
    }

    /// Takes the impulses of the sweep. Returns the energy fed in by the linear model: impulse times the distance
    /// between a port and the place at which the sweep saw the port.
    double take() {
        solve_again();
        double fed = 0;
        for (const auto& port : ports()) {
            const auto& node = blocks_.nodes[port.node];
            const auto seen = cast<double>(swept_.move_at(slot(node)));
            fed += dot(port.impulse, node.place - begin_of(node) - seen);
        }
        return fed / square(h_);
    }

    /// Energy within rounding and the tolerance of the solution.
    double trace(double gravity) const {
        double mass = 0, length = 0, kinetic = 0;
        for (const auto& node : unknowns())
            mass += node.mass, kinetic += 0.5 * node.mass * dot(node.velocity, node.velocity);
        for (const auto& link : links()) length += link.length;
        constexpr double share = 1e-6;
        return share * (mass * gravity * length + kinetic);
    }

    void store() {
        const auto drift = is_held() ? Vector{} : drift_of();
        for (auto& node : unknowns()) {
            const auto s = slot(node);
            const auto move = node.place - begin_of(node) - drift;
            swept_.set_move(s, cast<Real>(clamp_components(move, furthest())));
            swept_.mobility[s] = Real(blocks_.ports.mobilities[s]);
        }
        for (auto& link : links()) link.before = link.tension;
        for (const auto& link : own_links()) note(distances_.multiplier[link.constraint], link.tension * link.length);
        for (const auto& bend : bends()) note(angles_.multiplier[bend.constraint], bend.tension);
        for (auto& port : ports()) port.guess = port.impulse;
    }

  private:
    SweepState<D, Real>& swept_;
    Constraints<Distance<D>, Real>& distances_;
    Constraints<Angle<D>, Real>& angles_;
    Blocks<D>& blocks_;
    Block& block_;
    double h_;

    std::span<BlockNode<D>> nodes() const { return std::span(blocks_.nodes).subspan(block_.first_node, block_.nodes); }
    std::span<BlockNode<D>> unknowns() const { return nodes().first(block_.unknowns); }
    std::span<DistanceRow<D>> links() const {
        return std::span(blocks_.links).subspan(block_.first_link, block_.links);
    }
    /// All but the load tethers.
    std::span<DistanceRow<D>> own_links() const { return links().first(block_.links - block_.load_tethers); }
    std::span<AngleRow<D>> bends() const { return std::span(blocks_.bends).subspan(block_.first_bend, block_.bends); }
    Row slot(const BlockNode<D>& node) const {
        SINEW_ASSERT(swept_.slot_of[node.row] != no_row, "the sweep sees the nodes of a block with ports");
        return swept_.slot_of[node.row];
    }
    Vector begin_of(const BlockNode<D>& node) const { return cast<double>(swept_.place_at(slot(node))); }

    /// Bound of a displacement within which float stays finite.
    double furthest() const { return double(furthest_move(Real(h_))); }

    bool is_tethered() const {
        const auto tethers = links().last(block_.load_tethers);
        return std::any_of(tethers.begin(), tethers.end(), [](const auto& tether) { return tether.length > 0; });
    }

    /// State at the begin of the substep, with the impulses at the ports.
    void load() {
        for (auto& node : unknowns()) {
            const auto s = slot(node);
            node.start = begin_of(node);
            node.velocity = blocks_.ports.free_moves[s] * (1 / h_);
            const double mass = inverse_or_zero(blocks_.ports.mobilities[s]);
            block_.is_factorised = block_.is_factorised && mass == node.mass;
            node.mass = mass;
            node.push = {};
        }
        for (const auto& port : ports()) {
            auto& node = blocks_.nodes[port.node];
            node.push = port.impulse * (inverse_or_zero(node.mass) / square(h_));
        }
        for (auto& node : nodes().subspan(block_.unknowns)) {
            node.velocity = node.move = {};
            node.start = begin_of(node);
            node.place = node.start + cast<double>(swept_.move_at(slot(node))); // moving pins
        }
    }

    void start_tensions() {
        const double per = inverse_or_zero(square(h_));
        for (auto& link : links()) link.tension = link.before;
        for (auto& link : own_links())
            link.tension = block_.braced() ? 0 : -double(distances_.multiplier[link.constraint]) * per / link.length;
        for (auto& bend : bends()) bend.tension = -double(angles_.multiplier[bend.constraint]) * per;
    }
    void forget_tensions() {
        for (auto& link : links()) link.tension = 0;
        for (auto& bend : bends()) bend.tension = 0;
    }

    static constexpr int enough = 20; ///< iterations

    /// Solution by the factors of an earlier substep, where they serve, or by new ones.
    bool solve_by_chord() {
        load();
        if (!keeps_factors()) return false;
        const auto guess = [&](const BlockNode<D>& node) { return blocks_.ports.last_moves[slot(node)]; };
        if (block_.is_factorised && ChordSolve<D>(blocks_, block_, h_).run(guess)) return true;
        start_tensions();
        ChordSolve<D> solve(blocks_, block_, h_);
        block_.is_factorised = solve.run_anew(guess);
        if (block_.is_factorised) PortResponse<D>(solve, blocks_, block_).find();
        return block_.is_factorised;
    }
    /// Links that may be redundant have no tensions to start from.
    bool keeps_factors() const { return block_.bends == 0 && !block_.braced(); }
    void solve() {
        load();
        BlockSolve<D> solve(blocks_, block_, h_);
        if (!solve.run(Rule::implicit, enough, [] {})) find_nearest(solve);
        note_slack();
    }
    /// Solution with the last one for a guess.
    void solve_again() {
        load();
        if (block_.is_factorised && ChordSolve<D>(blocks_, block_, h_).run_again()) return note_slack();
        block_.is_factorised = false;
        BlockSolve<D> solve(blocks_, block_, h_);
        if (!solve.run_again(Rule::implicit, enough, [] {})) {
            start_tensions();
            if (!solve.run(Rule::implicit, enough, [] {})) find_nearest(solve);
        }
        note_slack();
    }
    void note_slack() {
        for (auto& link : links())
            link.slackened = link.slackened || (link.one_sided() && !(link.tension * link.side > 0));
    }

    /// Fallback if Newton's method does not converge: the nearest places to the free flight at which lengths are right;
    /// if none are found, a rigid translation with the mean motion.
    void find_nearest(BlockSolve<D>& solve) {
        constexpr int tries = 2, many = 20;
        for (auto& node : unknowns()) {
            node.start += node.velocity * h_ + node.push * square(h_);
            node.velocity = node.push = {};
        }
        forget_tensions();
        for (int i = 0; i < tries; ++i) {
            if (solve.run(Rule::place, many, [] {})) return;
            solve.sweep(); // comes nearer from anywhere
            for (auto& node : unknowns()) node.start = node.place;
            forget_tensions();
        }
        go_as_one();
    }
    void go_as_one() {
        load();
        const auto move = is_held() ? Vector{} : mean_move();
        for (auto& node : unknowns()) node.place = node.start + move;
    }
    bool is_held() const { return block_.fixed() || is_tethered(); }
    /// Mean motion of a free block under the impulses at the ports.
    Vector mean_move() const {
        double mass = 0;
        Vector sum{};
        for (const auto& node : unknowns()) sum += blocks_.ports.free_moves[slot(node)] * node.mass, mass += node.mass;
        for (const auto& port : ports()) sum += port.impulse;
        return sum * inverse_or_zero(mass);
    }

    /// Equations of simple links alone keep their factors for the chord method.
    void factorise(Held held) {
        BlockSolve<D> solve(blocks_, block_, h_);
        PortResponse<D> response(solve, blocks_, block_);
        response.factorise(held);
        response.find();
        block_.is_factorised = keeps_factors();
    }
    /// Displacements of the ports without impulses, by the linear model.
    void find_free_moves() {
        for (auto& port : ports()) {
            const auto& node = blocks_.nodes[port.node];
            port.free_move = node.place - begin_of(node);
            for (const auto& other : ports())
                port.free_move -= PortResponse<D>::response(blocks_, block_, port.number, other.number) * other.impulse;
        }
    }

    /// Momentum added by rounding, as a displacement: links only act within.
    Vector drift_of() const {
        double mass = 0;
        Vector sum{};
        for (const auto& node : unknowns()) sum += (node.place - begin_of(node)) * node.mass, mass += node.mass;
        return sum * inverse_or_zero(mass) - mean_move();
    }

    /// Force as a multiplier of the sweep.
    void note(Real& multiplier, double force) const {
        constexpr double most = double(limit::multiplier<Real>);
        multiplier = Real(clamp(-force * square(h_), -most, most));
    }
};

} // namespace sinew::detail

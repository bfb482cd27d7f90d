#pragma once

#include "sinew/solver/direct/chord.h"
#include "sinew/solver/direct/relax_links.h"
#include "sinew/solver/ports/port_block_state.h"
#include "sinew/solver/ports/port_response.h"

/// A block with ports, in one substep. Before the sweep the block is solved with the impulses of the last substep at
/// the ports; during the sweep the ports are linear about this solution; afterwards the block takes the new impulses.
///
/// Links pull along their new directions: maximum lengths form a convex set, and a projection onto a convex set adds no
/// energy. Old directions (SHAKE) keep the energy of a swing, but the pulls of a sweep are no smooth forces, and errors
/// left by one substep and repaired by the next would add up.
namespace sinew::detail {

template <int D, class Real> class PortBlock {
  public:
    PortBlock(World<D, Real>& world, Solver<D, Real>& solver, Block& block, Real h)
        : blocks_(solver.blocks), block_(block), state_(world, solver, block, h) {}

    PortBlockState<D, Real>& state() { return state_; }

    /// Linear about the guessed impulses.
    void predict() {
        for (auto& link : state_.links()) link.slackened = false;
        for (auto& port : state_.ports()) port.impulse = port.guess;
        state_.start_tensions();
        if (solve_by_chord()) {
            note_slack();
        } else {
            state_.start_tensions();
            solve();
            factorise(Held::as_solved);
        }
        find_free_moves();
    }
    /// Once more, linear about no impulse, with an upper bound of the mobility.
    void predict_loosely() {
        for (auto& port : state_.ports()) port.impulse = {};
        state_.start_tensions();
        solve();
        factorise(Held::at_least);
        block_.is_factorised = false;
        find_free_moves();
    }

    /// Takes the impulses of the sweep. Returns the energy fed in by the linear model: impulse times the distance
    /// between a port and the place at which the sweep saw the port.
    double take() {
        solve_again();
        double fed = 0;
        for (const auto& port : state_.ports()) {
            const auto& node = blocks_.nodes[port.node];
            const auto seen = state_.displacement_of(node);
            fed += dot(port.impulse, node.position - state_.begin_of(node) - seen);
        }
        return fed / square(state_.substep());
    }

  private:
    Blocks<D>& blocks_;
    Block& block_;
    PortBlockState<D, Real> state_;

    static constexpr int enough = 60; ///< iterations, with the releases of a convex set

    /// Solution by the factors of an earlier substep, where they serve, or by new ones.
    bool solve_by_chord() {
        state_.load();
        if (!keeps_factors()) return false;
        const auto guess = [&](const BlockNode<D>& node) { return state_.last_displacement_of(node); };
        if (block_.is_factorised && ChordSolve<D>(blocks_, block_, state_.substep()).run(guess)) return true;
        state_.start_tensions();
        ChordSolve<D> solve(blocks_, block_, state_.substep());
        block_.is_factorised = solve.run_anew(guess);
        if (block_.is_factorised) PortResponse<D>(solve, blocks_, block_).find();
        return block_.is_factorised;
    }
    /// Links that may be redundant have no tensions to start from.
    bool keeps_factors() const { return block_.bends == 0 && !block_.braced(); }
    void solve() {
        state_.load();
        BlockSolve<D> solve(blocks_, block_, state_.substep());
        solve.be_convex();
        if (!solve.run(Rule::backward_euler, enough, [] {})) find_nearest(solve);
        note_slack();
    }
    /// Solution with the last one for a guess.
    void solve_again() {
        state_.load();
        if (block_.is_factorised) {
            if (ChordSolve<D>(blocks_, block_, state_.substep()).run_again()) return note_slack();
            block_.is_factorised = false;
            start_anew();
        }
        BlockSolve<D> solve(blocks_, block_, state_.substep());
        solve.be_convex();
        if (!solve.run_again(Rule::backward_euler, enough, [] {})) {
            state_.start_tensions();
            if (!solve.run(Rule::backward_euler, enough, [] {})) find_nearest(solve);
        }
        note_slack();
    }
    /// Positions and tensions of the last substep: a chord method that failed has left them far from any solution.
    void start_anew() {
        for (auto& node : state_.unknowns()) node.position = node.start + state_.last_displacement_of(node);
        state_.start_tensions();
    }
    void note_slack() {
        for (auto& link : state_.links())
            link.slackened = link.slackened || (link.one_sided() && !(link.tension * link.side > 0));
    }

    /// Fallback if Newton's method does not converge: the nearest places to the free flight at which lengths are right;
    /// if none are found, a rigid translation with the mean motion.
    void find_nearest(BlockSolve<D>& solve) {
        constexpr int tries = 2, many = 20;
        for (auto& node : state_.unknowns()) {
            node.start += node.velocity * state_.substep() + node.acceleration * square(state_.substep());
            node.velocity = node.acceleration = {};
        }
        state_.forget_tensions();
        for (int i = 0; i < tries; ++i) {
            if (solve.run(Rule::static_projection, many, [] {})) return;
            relax_links(blocks_, block_); // comes nearer from anywhere
            for (auto& node : state_.unknowns()) node.start = node.position;
            state_.forget_tensions();
        }
        go_as_one();
    }
    void go_as_one() {
        state_.load();
        const auto displacement = state_.is_held() ? Vec<D, double>{} : state_.mean_displacement();
        for (auto& node : state_.unknowns()) node.position = node.start + displacement;
    }

    /// Equations of simple links alone keep their factors for the chord method.
    void factorise(Held held) {
        BlockSolve<D> solve(blocks_, block_, state_.substep());
        PortResponse<D> response(solve, blocks_, block_);
        response.factorise(held);
        response.find();
        block_.is_factorised = keeps_factors();
    }
    /// Displacements of the ports without impulses, by the linear model.
    void find_free_moves() {
        for (auto& port : state_.ports()) {
            const auto& node = blocks_.nodes[port.node];
            port.linear_move = node.position - state_.begin_of(node);
            port.free_move = port.linear_move;
            for (const auto& other : state_.ports())
                port.free_move -= PortResponse<D>::response(blocks_, block_, port.number, other.number) * other.impulse;
        }
    }
};

} // namespace sinew::detail

#pragma once

#include "sinew/solver/direct/newton.h"

namespace sinew::detail {

/// The chord method (simplified Newton): backward Euler with the factors of equations solved before, of links that have
/// turned little since. An iteration costs a substitution in place of a factorisation, and reduces the error by the
/// angle turned instead of squaring the error. With n_0 the link when the equations were factorised and n the link now,
///
///     (M / h^2 + K_0) move = M / h^2 (aim - x) - sum n tension + n_0 k C,      tension += k (C + n_0 . move)
///
/// whose fixed point is that of Newton's method. Any doubt is left to Newton's method: another set of active limits, a
/// move beyond the trust region, slow convergence.
template <int D> class ChordSolve : public BlockSolve<D> {
    using Base = BlockSolve<D>;

  public:
    using Base::Base, Base::unknowns, Base::node;
    using typename Base::Vector;

    /// Solves from the displacements guess(node). False without a solution in few iterations.
    template <class Guess> bool run(Guess&& guess) {
        begin(guess);
        return iterate();
    }
    /// Same as `run`, from the present positions.
    bool run_again() {
        Base::set_out(Rule::backward_euler);
        return iterate();
    }
    /// Same as `run`, with new factors.
    template <class Guess> bool run_anew(Guess&& guess) {
        begin(guess);
        Base::assemble(Rule::backward_euler);
        Base::solve();
        Base::take_step(1);
        return goes_well(0) || (Base::progress().share == 1 && iterate(1));
    }

  private:
    static constexpr int max_iterations = 4;
    static constexpr double slow = 0.25;     ///< ratio of moves, above which a factorisation is cheaper
    static constexpr double precise = 1e-8;  ///< error left, as a fraction of the total_length
    static constexpr double unknown = 1e-10; ///< same for the first move, whose error has no estimate

    using Base::good_enough, Base::links_, Base::sizes_;

    template <class Guess> void begin(Guess&& guess) {
        Base::set_out(Rule::backward_euler);
        for (auto& moved : unknowns()) moved.position = moved.start + guess(moved);
    }
    bool iterate(int first = 0) {
        if (first == 0)
            for (auto& link : links_.all()) keep_side(link);
        for (int i = first; i < max_iterations; ++i) {
            if (!find_residuals()) return false;
            solve_block_again(Base::blocks_, Base::block_);
            Base::take_step(1);
            if (Base::progress().share < 1) return false;
            if (goes_well(i)) return true;
            if (i > 0 && sizes_.moved > slow * sizes_.moved_before) return false;
        }
        return false;
    }
    bool goes_well(int iteration) { return is_precise(iteration) && Base::worst_error() <= good_enough; }
    /// True if the next moves, of a geometric series, would not matter.
    bool is_precise(int iteration) const {
        if (sizes_.moved <= unknown * Base::total_length()) return true;
        return iteration > 0 && square(sizes_.moved) <= precise * Base::total_length() * sizes_.moved_before;
    }

    /// A slack link near its limit is not held before it is too long.
    static void keep_side(DistanceRow<D>& link) {
        if (link.one_sided() && link.stiffness == 0 && link.tension == 0) link.side = 0;
    }

    /// True for a link too far from its direction in the factors: the response of ports is theirs, too.
    static bool has_turned(const DistanceRow<D>& link, const Vector& now) {
        constexpr double turn = 0.005; // radians
        const auto change = now - link.along;
        return dot(change, change) * link.per_length2 > square(turn);
    }

    /// Residuals at the present positions. False if the active limits are others than those of the factors, or if a
    /// link has turned.
    bool find_residuals() {
        for (auto& moved : unknowns()) moved.residual = (moved.predicted - moved.position) * moved.inertia;
        for (auto& link : links_.all()) {
            auto &a = node(link.a), &b = node(link.b);
            const auto now = b.position - a.position;
            const double length2 = dot(now, now);
            const double above = 0.5 * (length2 - square(link.high)), below = 0.5 * (length2 - square(link.low));
            if (link.side == 0) link.activate(above, below, good_enough * square(link.length));
            if ((link.side != 0) != (link.stiffness > 0)) return false;
            if (link.side == 0) continue;
            if (has_turned(link, now)) return false;
            const double push = link.stiffness * (link.side > 0 ? above : below);
            link.pull = link.tension + push;
            const auto force = now * link.tension + link.along * push;
            a.residual += force;
            b.residual -= force;
        }
        return true;
    }
};

} // namespace sinew::detail

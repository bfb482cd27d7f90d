#include "sinew/solver/direct/contact_rows.h"
#include "sinew/solver/direct/energy.h"
#include "sinew/solver/direct/joint_stops.h"
#include "sinew/solver/direct/project_velocities.h"
#include "sinew/solver/direct/step_chains.h"
#include "sinew/solver/workers.h"

namespace sinew {
namespace {

using detail::Rule;

/// Moves one block over a frame: in as few substeps as the midpoint rule allows; after a blow, the crack of a whip or a
/// fold in shorter ones, finally by backward Euler.
template <int D, class Real> class BlockStep {
  public:
    BlockStep(World<D, Real>& world, Solver<D, Real>& solver, const Block& block, double frame, double last_substep)
        : state_(world, solver, block, frame, last_substep), contact_(state_), frame_(frame) {}

    void run(int substeps) {
        longest_ = frame_ / substeps;
        for (int s = 0; s < substeps; ++s) advance(double(s) / substeps, double(s + 1) / substeps, 0);
    }
    /// Moves a chain over a part of the step, at a depth of division, from the tensions of its links on. Returns the
    /// energy lost, J.
    double redo(double longest, double from, double to, int depth, std::span<double> tensions) {
        const auto& chain = state_.blocks.chains.list[state_.block.chain];
        const auto before = [&](std::size_t i) -> double& {
            return state_.blocks.links[state_.blocks.chains.links[chain.first + i].link].before;
        };
        longest_ = longest;
        for (std::size_t i = 0; i < tensions.size(); ++i) before(i) = tensions[i];
        advance(from, to, depth);
        for (std::size_t i = 0; i < tensions.size(); ++i) tensions[i] = before(i);
        return lost();
    }
    void report_tensions(double substep) {
        state_.report_tensions(substep);
        contact_.report_pins(substep);
    }
    /// Energy lost where something struck, cracked or snapped taut, J.
    double lost() const { return lost_; }

  private:
    using Solve = detail::BlockSolve<D>;
    using Energy = detail::BlockEnergy<D>;

    static constexpr int deepest = 3;                          ///< maximum depth of division of a substep
    static constexpr int deepest_at_ends = 5;                  ///< same where joints reach their limits
    static constexpr int many = 40, stretched_iterations = 10; ///< iterations of the fallback solves
    detail::BlockState<D, Real> state_;
    detail::BlockContact<D, Real> contact_;
    double frame_, longest_ = 0; ///< durations of the step and of the longest substep, s
    double lost_ = 0;
    bool swung_ = false; ///< the last substep was a midpoint step: lengths and velocities are right

    void load(double from, double to) {
        state_.load(from, to);
        contact_.look();
    }
    bool run(Solve& solve, Rule rule, int iterations) {
        return solve.run(rule, iterations, [&] { return contact_.hold(solve.stiffness(), solve.progress()); });
    }
    bool refine(Solve& solve) {
        return solve.refine(Rule::swing, [&] { contact_.hold(solve.stiffness(), solve.progress()); });
    }
    /// True if only force fields and immovable nodes act from outside.
    bool moves_alone() const { return state_.works_alone() && !contact_.near(); }
    /// True if only force fields act from outside.
    bool is_free() const { return state_.fixed().empty() && !state_.motorized() && !contact_.near(); }

    /// Fits tolerances to light parts; and to free flight, which must not depend on how fast the whole flies.
    void fit(Solve& solve) const {
        if (moves_alone()) solve.find_light_trees();
        if (is_free()) solve.be_precise();
    }

    void advance(double from, double to, int depth) {
        load(from, to);
        Solve solve(state_.blocks, state_.block, state_.substep());
        fit(solve);
        Energy energy(solve, is_free());
        if (!swung_) {
            if (!project_positions(solve)) return solve_infeasible(from, to);
            if (solve.has_velocity_error(longest_)) {
                solve.choose_active_limits(Rule::implicit);
                note_lost(project_velocities(solve, energy));
            }
        }
        const auto went = swing(solve, energy, depth);
        swung_ = went == Went::well;
        if (swung_) return state_.store();
        if (state_.motorized() && !solve.run(Rule::place, many, [] {})) return solve_infeasible(from, to);
        const bool blow = depth > 0 && went == Went::against_something;
        if (blow || (depth >= deepest && went != Went::past_an_end)) return step_backward_euler(from, to, depth);
        advance_in_pieces(from, to, depth);
    }
    void advance_in_pieces(double from, double to, int depth) {
        constexpr int pieces = 4;
        const double piece = (to - from) / pieces;
        for (int i = 0; i < pieces; ++i)
            advance(from + piece * i, i + 1 == pieces ? to : from + piece * (i + 1), depth + 1);
    }

    enum class Went { well, against_something, past_an_end, too_far };

    /// Tries a midpoint step. A motion too large for one substep is left to shorter ones, as long as there are any.
    Went swing(Solve& solve, Energy& energy, int depth) {
        const bool shortest = depth >= deepest;
        constexpr int few = 8;             // iterations: where more are needed, shorter substeps are cheaper
        constexpr double overshoot = 2e-3; // radians beyond a joint's limit, or a fraction of half a range's length
        const bool lossless = loses_nothing(solve);
        if (lossless) solve.allow_overshoot();
        const bool found = run(solve, Rule::swing, few);
        if (struck(solve)) return Went::against_something;
        if (!found) return Went::too_far;
        constexpr double exact = 0.02, slight = 1e3; // in units of the rounding tolerance
        double gain = state_.works_alone() ? energy.gain() : 0;
        if (absolute(gain) > exact) {
            if (!refine(solve)) return Went::too_far;
            gain = energy.gain();
        }
        // Redundant links in a plane, exact to a millionth, press each other out of it: the harder, the shorter the
        // substep.
        const bool no_cut_helps = D == 3 && state_.block.braced();
        if (gain > (shortest || no_cut_helps ? slight : 1)) return Went::too_far;
        if (depth < deepest_at_ends && solve.worst_overshoot() > overshoot) return Went::past_an_end;
        const double per_h = 1 / state_.substep();
        for (auto& node : state_.unknowns()) node.velocity = (node.place - node.start) * (2 * per_h) - node.velocity;
        if (gain > 1) energy.slow_down(energy.due());
        bounce(solve, energy);
        if (any_tightened(lossless)) {
            note_lost(project_velocities(solve, energy));
        } else if (solve.has_velocity_error(longest_)) {
            const double kinetic = solve.kinetic();
            if (!remove_velocity_drift(solve, energy) && !shortest) return Went::too_far;
            note_lost(kinetic - solve.kinetic());
        }
        note_lost(energy.missing());
        energy.keep_momentum();
        // the mean gradient of a fold adds a little rotation
        if (lossless && is_free() && state_.block.ranges > 0) energy.slow_down(energy.due());
        return Went::well;
    }

    /// Repeats the substep by backward Euler. Without a solution the substep is divided: Newton's model is better over
    /// a shorter time. At the deepest level springs are disabled, and `creep` is the last resort.
    void step_backward_euler(double from, double to, int depth) {
        load(from, to);
        Solve solve(state_.blocks, state_.block, state_.substep());
        fit(solve);
        const Energy energy(solve, is_free());
        project_positions(solve);
        const double kinetic = solve.kinetic();
        bool found = run(solve, Rule::implicit, many);
        if (!found && depth < deepest) return advance_in_pieces(from, to, depth);
        if (!found && state_.block.springy) {
            state_.start_tensions();
            solve.bends().disable_springs(true);
            found = run(solve, Rule::implicit, many) && kinetic + energy.work() >= 0;
        }
        if (!found) creep(solve, energy, kinetic);
        if (contact_.near() || !state_.works_alone() || state_.block.springy)
            take_mean_velocities();
        else
            keep_flying();
        project_velocities(solve, energy);
        energy.keep_momentum();
        give_back(solve, energy, kinetic + energy.work());
        note_lost(kinetic + energy.work() - solve.kinetic());
        state_.store();
    }

    /// Backward Euler takes energy, most of it from a light part that whips; an undamped block gets it back, but for a
    /// thousandth, which is more than the rounding of all energies: none is gained.
    void give_back(const Solve& solve, const Energy& energy, double due) const {
        constexpr double share = 0.999;
        const double left = solve.kinetic();
        if (loses_nothing(solve) && !state_.block.springy)
            energy.bring_to(maximum(minimum(due, left + share * (due - left)), 0.0));
        else if (state_.works_alone())
            energy.slow_down(due);
    }

    /// Fallback: a linear step towards the solution, halved until lengths and energy are tolerable. Some of the way is
    /// always made, which leaves a state without a solution behind.
    void creep(Solve& solve, const Energy& energy, double kinetic) {
        constexpr double bearable = 1e-5;
        state_.forget_tensions();
        solve.bends().disable_springs(false);
        solve.use_penalty();
        run(solve, Rule::implicit, 1);
        const double most = maximum(bearable, solve.worst_start_strain());
        retreat([&] { return solve.worst_place_strain() <= most && kinetic + energy.work() >= 0; });
        state_.start_tensions();
    }

    /// Velocities as without links, for `settle` to project. A position not found to the last digit, over a short
    /// substep, would give wrong velocities to everything heavy.
    void keep_flying() {
        for (auto& node : state_.unknowns()) node.velocity += node.push * state_.substep();
    }

    /// Halves the displacement until `bearable()`, at most 20 times.
    template <class Bearable> void retreat(Bearable&& bearable) {
        constexpr int halvings = 20;
        for (int i = 0; i < halvings && !bearable(); ++i)
            for (auto& node : state_.unknowns()) node.place = (node.place + node.start) * 0.5;
    }

    /// Step of a block pinned further apart than its length: as near to the lengths as possible.
    void solve_infeasible(double from, double to) {
        load(from, to);
        state_.forget_tensions();
        Solve solve(state_.blocks, state_.block, state_.substep());
        const double before = solve.worst_start_strain();
        solve.use_penalty();
        run(solve, Rule::implicit, stretched_iterations);
        constexpr double most = 10;
        retreat([&] { return solve.worst_place_strain() <= maximum(most, before); });
        contact_.lift(); // the solve has not converged
        take_mean_velocities();
        state_.forget_tensions();
        state_.store();
    }

    void take_mean_velocities() {
        const double per_h = 1 / state_.substep();
        for (auto& node : state_.unknowns()) node.velocity = (node.place - node.start) * per_h;
    }

    /// Brings a figure that was placed stretched, or torn from its pins, to its lengths without a velocity. False if
    /// the pins are too far apart.
    bool project_positions(Solve& solve) {
        constexpr double crude = 1e-3;
        const double before = solve.worst_start_strain();
        if (before <= crude) return true;
        for (auto& node : state_.fixed()) std::swap(node.start, node.place);
        state_.forget_tensions();
        const bool met = solve.run(Rule::place, many, [] {});
        if (!met) solve.sweep();
        const double after = solve.worst_place_strain();
        if (after < before)
            for (auto& node : state_.unknowns()) node.start = node.place;
        for (auto& node : state_.fixed()) std::swap(node.start, node.place);
        state_.start_tensions();
        return met || after <= crude;
    }

    /// True if energy has to be conserved: no damping, no work from outside. A joint then bounces from its limit.
    bool loses_nothing(const Solve& solve) const {
        constexpr double far_outside = 2e-2; // radians; a joint placed further out is brought back
        return state_.world.settings.damping == Real(0) && state_.works_alone() && !contact_.near() &&
               solve.bends().worst_outside() < far_outside;
    }
    /// Bounces joints from their limits. A joint that comes to rest on a limit has little energy, which goes back into
    /// the rest of the motion.
    void bounce(Solve& solve, const Energy& energy) const {
        constexpr double part = 1e-5, tiny = 1e-7; // fractions of the energy, and of weight times length
        const double kinetic = solve.kinetic();
        const double little = part * energy.inner() + tiny * solve.weight() * solve.reach();
        if (detail::BlockBounce<D>(solve, little).run()) energy.bring_to(minimum(kinetic, energy.due()));
    }

    /// True if a node has reached a plane, or a joint a limit: a blow follows, not a swing.
    bool struck(const Solve& solve) { return contact_.struck() || solve.bends().any_struck(); }

    bool any_tightened(bool ranges_bounce) const {
        for (const auto& link : state_.links())
            if (link.low < link.high && link.before == 0 && link.tension != 0 && !(ranges_bounce && link.is_range()))
                return true;
        for (const auto& way : state_.ways())
            if (way.one_sided() && way.before == 0 && way.tension != 0) return true;
        return false;
    }

    /// Energy is accounted only while nothing from outside does work.
    void note_lost(double energy) {
        if (state_.works_alone()) lost_ += energy;
    }

    /// Projects the velocities. Returns the energy lost, J.
    double project_velocities(Solve& solve, const Energy& energy) {
        constexpr int few = 3, many = 30;
        constexpr double rounding = 1e-6;
        const double kinetic = solve.kinetic();
        const auto gains = [&] { return moves_alone() && !(solve.kinetic() <= (1 + rounding) * kinetic); };
        for (const int rounds : {few, many}) {
            detail::project_block_velocities(
                solve, [&](double k) { contact_.rebound(k); }, rounds);
            if (!gains()) break;
            for (auto& node : state_.unknowns()) node.velocity = node.aim; // a projection gains nothing: not converged
        }
        if (moves_alone()) energy.slow_down(kinetic);
        return kinetic - solve.kinetic();
    }

    /// Removes velocities along the links, an error of the integrator after the crack of a whip, and gives their energy
    /// back to the allowed motion. False if the error is large.
    bool remove_velocity_drift(Solve& solve, const Energy& energy) {
        constexpr double much = 1.02;
        const double kinetic = solve.kinetic(), inner = energy.inner();
        project_velocities(solve, energy);
        const bool little = inner <= much * energy.inner();
        if (!state_.motorized()) energy.bring_to(kinetic);
        return little;
    }
};

/// Number of blocks handed to a thread at a time.
constexpr int a_part = 8;
constexpr std::size_t worth_a_thread = 500; ///< nodes; for fewer, starting threads takes longer than the work

struct ChainFrame {
    double frame, report_substep; ///< duration of the step, and of the substep that multipliers are reported for, s
    int substeps;
};

/// Moves the chains, in parts of consecutive turns. `move(block)` moves a block that does not fit into the lanes.
template <int D, class Real, class Move>
void step_chains(World<D, Real>& world, Solver<D, Real>& solver, int threads, const ChainFrame& frame,
                 const Move& move) {
    auto& blocks = solver.blocks;
    const std::span<const ChainTurn> turns = blocks.chains.turns;
    const int most = int(blocks.chains.spaces.size()), parts = std::min(most, detail::parts_of_chains(threads));
    Workers::run(threads, parts, [&](int part) {
        const auto redo = [&](Block& block, double from, double to, int depth, std::span<double> tensions) {
            BlockStep<D, Real> step(world, solver, block, frame.frame, double(world.last_substep));
            return step.redo(frame.frame / frame.substeps, from, to, depth, tensions);
        };
        const auto begin = [&](int i) {
            return turns.begin() + std::ptrdiff_t(turns.size() * std::size_t(i) / std::size_t(parts));
        };
        detail::ChainStep<D, Real> step(world, solver, blocks.chains.spaces[std::size_t(part)], frame.frame,
                                        frame.substeps);
        for (auto first = begin(part), end = begin(part + 1); first != end;) {
            const auto last = std::find_if(first, end, [&](const auto& turn) { return turn.links != first->links; });
            step.run({first, last}, frame.report_substep, move, redo);
            first = last;
        }
    });
}

template <int D> int parts_of(const Blocks<D>& blocks) {
    return int((blocks.list.size() + a_part - 1) / a_part);
}
template <int D> std::span<Block> part_of(Blocks<D>& blocks, int part) {
    const auto first = std::size_t(part) * a_part;
    return std::span(blocks.list).subspan(first, std::min<std::size_t>(a_part, blocks.list.size() - first));
}

} // namespace

template <int D, class Real> void step_blocks(World<D, Real>& world, Solver<D, Real>& solver, Real dt, Real substep) {
    auto& blocks = solver.blocks;
    if (blocks.list.empty()) return;
    std::fill(blocks.pin_of.begin(), blocks.pin_of.end(), Blocks<D>::none);
    for (std::uint32_t i = 0; i < world.pins.size(); ++i) {
        const auto row = world.particles.slots.find(world.pins[i].particle);
        if (!row) continue;
        blocks.next_pin[i] = blocks.pin_of[*row];
        blocks.pin_of[*row] = i;
    }
    constexpr int few = 2;
    const int substeps = world.settings.substeps > 0 ? world.settings.substeps : few;
    const auto move = [&](Block& block) {
        detail::follow_rows(world, blocks, block);
        BlockStep<D, Real> step(world, solver, block, double(dt), double(world.last_substep));
        step.run(substeps);
        step.report_tensions(double(substep));
        block.lost = step.lost();
    };
    const int wanted = solver.options.threads > 0 ? solver.options.threads : hardware_threads();
    const int threads = blocks.nodes.size() < worth_a_thread ? 1 : wanted;
    const bool in_lanes = detail::ChainStep<D, Real>::serves(world) && !blocks.chains.turns.empty();
    if (in_lanes) step_chains(world, solver, threads, {double(dt), double(substep), substeps}, move);
    if (!in_lanes || blocks.chains.turns.size() < blocks.list.size())
        Workers::run(threads, parts_of(blocks), [&](int part) {
            for (auto& block : part_of(blocks, part))
                if (!in_lanes || block.chain == Blocks<D>::none) move(block);
        });
    for (const auto& block : blocks.list) world.energy_lost += block.lost;
}

#define SINEW_BLOCK_STEP(D, Real) template void step_blocks(World<D, Real>&, Solver<D, Real>&, Real, Real);
SINEW_INSTANTIATE(SINEW_BLOCK_STEP)

} // namespace sinew

#include "sinew/solver/direct/backward_euler_step.h"
#include "sinew/solver/direct/midpoint_step.h"
#include "sinew/solver/direct/step_chains.h"
#include "sinew/solver/direct/step_programs.h"
#include "sinew/solver/workers.h"

namespace sinew {
namespace {

using detail::Rule;

/// Moves one block over a frame: in as few substeps as the midpoint rule allows; after a blow, the crack of a whip or a
/// fold in shorter ones, finally by backward Euler.
template <int D, class Real> class BlockStep {
  public:
    BlockStep(World<D, Real>& world, Solver<D, Real>& solver, const Block& block, double frame,
              std::optional<double> last_substep)
        : state_(world, solver, block, frame, last_substep), contact_(state_), frame_(frame) {}

    void run(int substeps) {
        longest_ = frame_ / substeps;
        for (int s = 0; s < substeps; ++s) advance(double(s) / substeps, double(s + 1) / substeps, 0);
    }
    /// Moves a block over a part of the step, at a depth of division. Returns the energy lost, J.
    double redo(double longest, double from, double to, int depth) {
        longest_ = longest;
        advance(from, to, depth);
        return lost();
    }
    void report_tensions(double substep) {
        state_.report_tensions(substep);
        contact_.report_pins(substep);
    }
    /// Energy lost where something struck, cracked or snapped taut, J.
    double lost() const { return lost_; }

  private:
    using Substep = detail::BlockSubstep<D, Real>;
    using Midpoint = detail::MidpointStep<D, Real>;
    using Went = detail::Went;

    static constexpr int stretched_iterations = 10;
    detail::BlockState<D, Real> state_;
    detail::BlockContact<D, Real> contact_;
    double frame_, longest_ = 0; ///< durations of the step and of the longest substep, s
    double lost_ = 0;
    bool swung_ = false; ///< the last substep was a midpoint step: lengths and velocities are right

    void load(double from, double to) {
        state_.load(from, to);
        contact_.find_near();
    }

    void advance(double from, double to, int depth) {
        load(from, to);
        Substep substep(state_, contact_, lost_);
        substep.fit();
        auto& solve = substep.solve();
        if (!swung_) {
            if (!substep.project_positions()) return solve_infeasible(from, to);
            if (solve.has_velocity_error(longest_)) {
                solve.choose_active_limits(Rule::backward_euler);
                substep.note_lost(substep.project_velocities());
            }
        }
        const auto went = Midpoint(substep, longest_, depth).run();
        swung_ = went == Went::well;
        if (swung_) return state_.store();
        if (state_.motorized() && !solve.run(Rule::static_projection, substep.many, [] {}))
            return solve_infeasible(from, to);
        const bool blow = depth > 0 && went == Went::against_something;
        if (blow || (depth >= Midpoint::deepest && went != Went::past_an_end))
            return step_backward_euler(from, to, depth);
        advance_in_pieces(from, to, depth);
    }
    void advance_in_pieces(double from, double to, int depth) {
        constexpr int pieces = 4;
        const double piece = (to - from) / pieces;
        for (int i = 0; i < pieces; ++i)
            advance(from + piece * i, i + 1 == pieces ? to : from + piece * (i + 1), depth + 1);
    }

    /// Repeats the substep by backward Euler. Without a solution the substep is divided: Newton's model is better over
    /// a shorter time.
    void step_backward_euler(double from, double to, int depth) {
        load(from, to);
        Substep substep(state_, contact_, lost_);
        substep.fit();
        if (!detail::BackwardEulerStep<D, Real>(substep).run(depth >= Midpoint::deepest))
            return advance_in_pieces(from, to, depth);
        state_.store();
    }

    /// Step of a block pinned further apart than its length, or found so stretched that no solution is near: as near to
    /// the lengths as possible. The way back to them is no gain in speed, and tightens springs by no more than the
    /// energy that there is: what has not converged may be anywhere.
    void solve_infeasible(double from, double to) {
        load(from, to);
        state_.forget_tensions();
        Substep substep(state_, contact_, lost_);
        auto& solve = substep.solve();
        const double before = solve.worst_start_strain(), kinetic = solve.kinetic();
        solve.use_penalty();
        substep.run(Rule::backward_euler, stretched_iterations);
        constexpr double max_strain = 10;
        const auto& energy = substep.energy();
        const auto is_possible = [&] {
            return !state_.works_alone() || energy.gain_of_springs() <= kinetic + max(energy.work_of_fields(), 0.0);
        };
        substep.retreat([&] { return solve.worst_position_strain() <= max(max_strain, before) && is_possible(); });
        contact_.push_out(); // the solve has not converged
        substep.take_mean_velocities();
        if (state_.works_alone()) energy.slow_down(max(kinetic + energy.work(), 0.0));
        state_.forget_tensions();
        state_.store();
    }
};

/// Number of blocks handed to a thread at a time.
constexpr int a_part = 8;
constexpr std::size_t worth_a_thread = 500; ///< nodes; for fewer, starting threads takes longer than the work

struct LaneFrame {
    double frame, report_substep; ///< duration of the step, and of the substep that multipliers are reported for, s
    int substeps;
};

/// Moves blocks side by side, in parts of consecutive turns. `move(block)` moves a block that does not fit into the
/// lanes.
template <template <int, class> class Step, int D, class Real, class Turn, class Space, class Move>
void step_in_lanes(World<D, Real>& world, Solver<D, Real>& solver, const std::vector<Turn>& turns,
                   std::vector<Space>& spaces, int threads, const LaneFrame& frame, const Move& move) {
    const int parts = std::min(int(spaces.size()), detail::parts_in_lanes(threads));
    if (turns.empty()) return;
    Workers::run(threads, parts, [&](int part) {
        const auto redo = [&](Block& block, double from, double to, int depth) {
            BlockStep<D, Real> step(world, solver, block, frame.frame, std::nullopt);
            return step.redo(frame.frame / frame.substeps, from, to, depth);
        };
        const auto begin = [&](int i) {
            return turns.begin() + std::ptrdiff_t(turns.size() * std::size_t(i) / std::size_t(parts));
        };
        Step<D, Real> step(world, solver, spaces[std::size_t(part)], frame.frame, frame.substeps);
        for (auto first = begin(part), end = begin(part + 1); first != end;) {
            const auto last =
                std::find_if(first, end, [&](const Turn& turn) { return !Step<D, Real>::are_alike(turn, *first); });
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
    blocks.answers.clear();
    std::fill(blocks.pin_of.begin(), blocks.pin_of.end(), Blocks<D>::none);
    for (std::uint32_t i = 0; i < world.pins.size(); ++i) {
        const auto row = world.particles.handles.find(world.pins[i].particle);
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
    const int chosen = solver.options.threads_wanted(), wanted = chosen > 0 ? chosen : hardware_threads();
    const int threads = blocks.nodes.size() < worth_a_thread ? 1 : wanted;
    const bool in_lanes = detail::serves_lanes(world);
    if (in_lanes) {
        const LaneFrame frame{double(dt), double(substep), substeps};
        auto& chains = blocks.chains;
        auto& programs = blocks.programs;
        step_in_lanes<detail::ChainStep>(world, solver, chains.turns, chains.spaces, threads, frame, move);
        step_in_lanes<detail::ProgramStep>(world, solver, programs.turns, programs.spaces, threads, frame, move);
    }
    const auto is_done = [&](const Block& block) {
        return in_lanes && (block.chain != Blocks<D>::none || block.program != Blocks<D>::none);
    };
    if (!in_lanes || blocks.chains.turns.size() + blocks.programs.turns.size() < blocks.list.size())
        Workers::run(threads, parts_of(blocks), [&](int part) {
            for (auto& block : part_of(blocks, part))
                if (!is_done(block)) move(block);
        });
    for (const auto& block : blocks.list) world.energy_lost += block.lost;
}

#define SINEW_BLOCK_STEP(D, Real) template void step_blocks(World<D, Real>&, Solver<D, Real>&, Real, Real);
SINEW_INSTANTIATE(SINEW_BLOCK_STEP)

} // namespace sinew
